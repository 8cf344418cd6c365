"""The API schemas applied to a particle field: what they provide, and which are not registered."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from itertools import chain
from typing import TYPE_CHECKING, Any, NamedTuple

from pxr import Usd

from usdvol_lint import schema, spelling
from usdvol_lint.facts.particles.removed import RemovedApis, removed_apis
from usdvol_lint.facts.usd.dropped import DroppedList
from usdvol_lint.facts.usd.instances import on_stage
from usdvol_lint.facts.usd.kinds import PrimKinds, is_registered, raw_apis

if TYPE_CHECKING:
    from usdvol_lint.facts.prims import Prims

_BROUGHT = {
    schema.POSITION_BASE: "positions",
    schema.KERNEL_BASE: "a kernel",
    schema.RADIANCE_BASE: "radiance",
}

_MISSING = {
    schema.POSITION_BASE: "PRT001",
    schema.KERNEL_BASE: "PRT002",
    schema.RADIANCE_BASE: "PRT003",
}
"""The rules that tell which base API is missing."""


class ParticleApis(NamedTuple):
    """The API schemas of one prim.

    `applied` are the registered ones and those that they include, in order.
    `third_party` are names in `apiSchemas` that are not registered and resemble none of UsdVol's:
    this USD ignores them, another installation may know them.
    `misspelt` maps other names that are not registered to the API that was probably intended.
    `dropped` are the lists that USD does not have since a name stands in one twice.
    `removed` are those that a stronger spec takes away, though the prim needs them.
    `awaited` are the APIs of which a rule tells that they were meant: under other names, in these
    lists or before they were taken away.
    `built_in_type` says that the prim type is UsdVol's own, so that its APIs are all known.
    """

    applied: tuple[str, ...]
    third_party: tuple[str, ...]
    misspelt: dict[str, str]
    built_in_type: bool
    dropped: tuple[DroppedList, ...] = ()
    removed: tuple[RemovedApis, ...] = ()
    awaited: tuple[str, ...] = ()

    def has(self, api: str) -> bool:
        """Whether the API is applied, or awaited."""
        return api in self.applied or api in schema.expand_apis(self.awaited)

    def providers(self, base: str) -> tuple[str, ...]:
        """The applied APIs that include a base API and that no other such API includes."""
        providers = [api for api in self.applied if api != base and base in _includes(api)]
        included = {api for provider in providers for api in _includes(provider) if api != provider}
        return tuple(api for api in providers if api not in included)

    def absent(self, *apis: str) -> tuple[str, ...]:
        """The words for APIs that are not applied, but for those that a mistake takes away."""
        meant = (*self.misspelt.values(), *_names(self.dropped), *_names(self.removed))
        lost = schema.expand_apis(meant)
        return tuple(schema.applied(api) for api in apis if api not in lost)

    def is_lost(self, base: str) -> bool:
        """Whether a base API is missing because one that includes it is awaited."""
        return base in self.lost_with(self.awaited)

    def lost_with(self, names: Iterable[str]) -> tuple[str, ...]:
        """The base APIs that are missing, and that APIs of these names would bring."""
        brought = schema.expand_apis(tuple(names))
        return tuple(
            base for base in schema.BASE_APIS if base not in self.applied and base in brought
        )

    def remedy(self, base: str, otherwise: str) -> str:
        """The advice for a missing base API: to correct a misspelt name, or else `otherwise`."""
        for name, intended in self.misspelt.items():
            if base in schema.expand_apis((intended,)):
                return f"write {intended!r} for {name!r}"
        return otherwise

    def unread(self, prim: Any, base: str) -> str:
        """What to add to a message about a missing base API: the attributes that nobody reads."""
        names = [
            repr(attribute.GetName())
            for api, attributes in _without_api(prim, self)
            if base in schema.API_INCLUDES[api]
            for attribute in attributes
        ]
        verb = "is" if len(names) == 1 else "are"
        return f", so {' and '.join(names)} {verb} not read" if names else ""

    @property
    def doubt(self) -> str:
        """What to add to a message about something missing: who else may provide it."""
        names = ", ".join(map(repr, self.third_party))
        return f"; {names}, unknown to this USD, may provide this" if names else ""


def read_particle_apis(
    prim: Any, kinds: PrimKinds, prims: Prims, tells: Callable[[str], bool]
) -> ParticleApis:
    """Reads the applied schemas, those that are not registered too; `tells`: as `Tables.tells`."""
    applied = tuple(dict.fromkeys(kinds.applied(prim)))
    unregistered = [
        name
        for name in raw_apis(prim)
        if name not in applied and not is_registered(name.partition(":")[0])
    ]
    intended = {name: spelling.misspelt_api(name) for name in unregistered}
    misspelt = {name: api for name, api in intended.items() if api}
    dropped = prims.dropped_lists(prim)
    removed = removed_apis(prim, applied) if prims.authored(prim).lacks_apis else ()
    return ParticleApis(
        applied=applied,
        third_party=tuple(name for name in unregistered if not intended[name]),
        misspelt=misspelt,
        built_in_type=prim.GetTypeName() in schema.CONCRETE_TYPES,
        dropped=dropped,
        removed=removed,
        awaited=(
            *(misspelt.values() if tells("PRT006") else ()),
            *(_names(dropped) if tells("PRT009") else ()),
            *(_names(removed) if tells("PRT010") else ()),
        ),
    )


def _names(lists: Iterable[DroppedList | RemovedApis]) -> Iterator[str]:
    return chain.from_iterable(each.names for each in lists)


def attributes_without_api(
    prim: Any, apis: ParticleApis, tells: Callable[[str], bool]
) -> Iterator[tuple[str, list[Any]]]:
    """The attributes that are authored on a prim though no schema of it declares them, by API.

    Left out are those of an API whose base is missing too, as far as a rule tells that.
    """
    told = {base for base, code in _MISSING.items() if base not in apis.applied and tells(code)}
    for api, attributes in _without_api(prim, apis):
        if told.isdisjoint(schema.API_INCLUDES[api]):
            yield api, attributes


def _without_api(prim: Any, apis: ParticleApis) -> Iterator[tuple[str, list[Any]]]:
    declared = frozenset(prim.GetPrimDefinition().GetPropertyNames())
    for api, names in schema.API_ATTRIBUTES.items():
        if not apis.has(api):
            attributes = [prim.GetAttribute(name) for name in names if name not in declared]
            authored = [attribute for attribute in attributes if attribute.HasAuthoredValue()]
            if authored:
                yield api, authored


class Loss(NamedTuple):
    """What a particle field lacks without some APIs: `words` end a message.

    `is_total`: whether it is something that must be there, and that nothing else may bring.
    """

    words: str
    is_total: bool


def loss(prim: Any, apis: ParticleApis, names: Iterable[str]) -> Loss:
    """What a prim lacks because APIs of these names are not applied."""
    lost = apis.lost_with(names)
    if not lost:
        return Loss("", False)
    words = " or ".join(_BROUGHT[base] for base in lost)
    is_bound = lost == (schema.RADIANCE_BASE,) and material_is_bound(prim)
    return Loss(f", so nothing gives these splats {words}", not apis.third_party and not is_bound)


def material_is_bound(prim: Any) -> bool:
    """Whether a material is bound to the prim, by itself, an ancestor or a collection.

    In a prototype that is so where the first instance shows it: what is bound to an instance, its
    prototype does not have.
    """
    from pxr import UsdShade  # costs start-up time, and few stages ask

    material, _ = UsdShade.MaterialBindingAPI(on_stage(prim)).ComputeBoundMaterial()
    return bool(material)


def _includes(api: str) -> tuple[str, ...]:
    if api in schema.API_INCLUDES:
        return schema.API_INCLUDES[api]
    definition = Usd.SchemaRegistry().FindAppliedAPIPrimDefinition(api)
    return tuple(definition.GetAppliedAPISchemas()) if definition else ()
