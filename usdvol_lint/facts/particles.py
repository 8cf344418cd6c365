"""The applied APIs of a particle field: what they provide, and which of them nobody knows."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from pxr import Usd

from usdvol_lint import schema
from usdvol_lint.facts.kinds import Kinds, raw_apis


@dataclass(frozen=True, slots=True)
class ParticleApis:
    """The APIs of one prim.

    `applied` are the registered ones with all that they bring along, in order.
    `unregistered` are names in `apiSchemas` that no plugin declares: USD ignores them.
    `built_in_type` says that the prim type is UsdVol's own, so its APIs are all known.
    """

    applied: tuple[str, ...]
    unregistered: tuple[str, ...]
    built_in_type: bool

    def providers(self, base: str) -> tuple[str, ...]:
        """The applied APIs, the base itself aside, that bring that base API along."""
        return tuple(api for api in self.applied if api != base and base in _includes(api))

    @property
    def third_party(self) -> tuple[str, ...]:
        """Unregistered APIs that are not a misspelling of one of ours."""
        return tuple(name for name in self.unregistered if not misspelt_api(name))


def read_particle_apis(prim: Any, kinds: Kinds) -> ParticleApis:
    """Reads the applied schemas, composed and raw."""
    applied = tuple(dict.fromkeys(kinds.applied(prim)))
    known = set(applied)
    unregistered = tuple(
        name for name in raw_apis(prim) if name not in known and not _is_registered_api(name)
    )
    return ParticleApis(applied, unregistered, prim.GetTypeName() in schema.CONCRETE_TYPES)


def misspelt_api(name: str) -> str | None:
    """The API of UsdVol that an unregistered name was probably meant to be."""
    return schema.PRE_STANDARD_APIS.get(name) or schema.nearest(name, tuple(schema.API_INCLUDES))


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


def _is_registered_api(name: str) -> bool:
    family, _, _ = name.partition(":")
    return bool(Usd.SchemaRegistry.GetTypeFromName(family))
