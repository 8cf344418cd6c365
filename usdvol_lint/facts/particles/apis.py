"""The applied APIs of a particle field: what they provide, and which of them nobody knows."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from pxr import Usd

from usdvol_lint import schema, spelling
from usdvol_lint.facts.usd.kinds import Kinds, is_registered, raw_apis


@dataclass(frozen=True, slots=True)
class ParticleApis:
    """The APIs of one prim.

    `applied` are the registered ones with all that they bring along, in order.
    `third_party` are names in `apiSchemas` that no plugin declares and that look like none of
    ours: USD ignores them, another installation may know them.
    `misspelt` are those that no plugin declares either, by the API that was probably meant.
    `built_in_type` says that the prim type is UsdVol's own, so that its APIs are all known.
    """

    applied: tuple[str, ...]
    third_party: tuple[str, ...]
    misspelt: dict[str, str]
    built_in_type: bool

    def has(self, api: str) -> bool:
        """Whether the API is applied, or would be if no name were misspelt."""
        return api in self.applied or api in schema.expand_apis(tuple(self.misspelt.values()))

    def providers(self, base: str) -> tuple[str, ...]:
        """The applied APIs that bring that base API along, and that no other provider brings."""
        providers = [api for api in self.applied if api != base and base in _includes(api)]
        brought = {api for provider in providers for api in _includes(provider) if api != provider}
        return tuple(api for api in providers if api not in brought)

    def remedy(self, base: str, otherwise: str) -> str:
        """How to get a missing base API: by spelling an API right, or else as the rule says."""
        for name, meant in self.misspelt.items():
            if base in schema.expand_apis((meant,)):
                return f"write {meant!r} for {name!r}"
        return otherwise

    @property
    def doubt(self) -> str:
        """What to add to the words that something is missing: who else may provide it."""
        names = ", ".join(map(repr, self.third_party))
        return f"; {names}, unknown to this USD, may provide this" if names else ""


def read_particle_apis(prim: Any, kinds: Kinds) -> ParticleApis:
    """Reads the applied schemas, composed and raw."""
    applied = tuple(dict.fromkeys(kinds.applied(prim)))
    unregistered = [
        name
        for name in raw_apis(prim)
        if name not in applied and not is_registered(name.partition(":")[0])
    ]
    meant = {name: spelling.misspelt_api(name) for name in unregistered}
    return ParticleApis(
        applied=applied,
        third_party=tuple(name for name in unregistered if not meant[name]),
        misspelt={name: api for name, api in meant.items() if api},
        built_in_type=prim.GetTypeName() in schema.CONCRETE_TYPES,
    )


def material_is_bound(prim: Any) -> bool:
    """Whether a material is bound to the prim, by itself, an ancestor or a collection."""
    from pxr import UsdShade  # costs start-up time, and few stages ask

    material, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()
    return bool(material)


def _includes(api: str) -> tuple[str, ...]:
    if api in schema.API_INCLUDES:
        return schema.API_INCLUDES[api]
    definition = Usd.SchemaRegistry().FindAppliedAPIPrimDefinition(api)
    return tuple(definition.GetAppliedAPISchemas()) if definition else ()
