"""The variant sets of a composed stage, and which variants matter to the prims that we check."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import chain
from typing import Any, NamedTuple, TypeAlias

from pxr import Sdf, Usd

from usdvol_lint import schema
from usdvol_lint.facts.usd.calls import ARCS, DRAWN_BELOW, get_path
from usdvol_lint.facts.usd.drawn import Drawn
from usdvol_lint.facts.usd.kinds import PrimKinds

_CHECKED = frozenset(
    {
        *(schema.VOLUME, schema.FIELD, schema.PARTICLE_FIELD),
        *(schema.UNKNOWN_TYPE, schema.ABSTRACT_TYPE),
        *schema.API_INCLUDES,
    }
)
"""The schemas of prims that make a variant worth composing."""
_BRINGS = (*ARCS, "apiSchemas", "active", "variantSelection")
"""Metadata of a spec without a type that puts prims on the stage, or changes what they are."""

VariantSpec: TypeAlias = tuple[str, str]
"""A variant in a layer: the layer's identifier, and the path in it."""


class Survey(NamedTuple):
    """Part of the stage as it is composed now.

    `switches` are the prims with variant sets, `holders` the paths of the prims that we check and
    of all prims above them.
    """

    switches: list[Any]
    holders: set[Any]


class Variant(NamedTuple):
    """A variant of a prim; `specs` are the prim specs of its opinions, strongest first."""

    set_name: str
    name: str
    is_selected: bool
    specs: dict[VariantSpec, Any]


def survey(stage: Any, start: Any, kinds: PrimKinds) -> Survey:
    """Looks at `start` and all prims below it, into all prototypes, and at what instancers draw."""
    switches, checked, instancers = [], [], []
    starts = [*([start] if start else []), *stage.GetPrototypes()]
    surveyed: set[Any] = set()
    while starts:
        surveyed.update(starts)
        for prim in chain.from_iterable(Usd.PrimRange(each, DRAWN_BELOW) for each in starts):
            names = kinds.names(kinds.key(prim))
            if not _CHECKED.isdisjoint(names):
                checked.append(prim)
            if schema.POINT_INSTANCER in names:
                instancers.append(prim)
            if prim.HasVariantSets():
                switches.append(prim)
        starts = sorted(Drawn(instancers).roots - surveyed, key=get_path)
    return Survey(switches, _holders(checked))


def _holders(prims: Iterable[Any]) -> set[Any]:
    """The paths of the prims and of all above them; instances hold what their prototype does."""
    holders: set[Any] = set()
    waiting = list(prims)
    while waiting:
        prim = waiting.pop()
        while prim and prim.GetPath() not in holders:
            holders.add(prim.GetPath())
            if prim.IsPrototype():
                waiting += prim.GetInstances()
            prim = prim.GetParent()
    return holders


def variants(prim: Any) -> Iterator[Variant]:
    """The variants of all variant sets of a prim."""
    stack = prim.GetPrimStack()
    sets = prim.GetVariantSets()
    for set_name in sets.GetNames():
        selected = sets.GetVariantSelection(set_name)
        for name in sets.GetVariantSet(set_name).GetVariantNames():
            specs = {}
            for spec in stack:
                variant_set = spec.variantSets.get(set_name)
                found = variant_set.variants.get(name) if variant_set else None
                if found:
                    specs[spec.layer.identifier, str(found.path)] = found.primSpec
            yield Variant(set_name, name, name == selected, specs)


def may_bring(spec: Any, kinds: PrimKinds) -> bool:
    """Whether a variant's prim spec, or one below it, may put prims on the stage that we check."""
    waiting = [spec]
    while waiting:
        spec = waiting.pop()
        type_name = spec.typeName
        untyped = spec.specifier == Sdf.SpecifierDef and not type_name
        if untyped or not _CHECKED.isdisjoint(kinds.names((type_name,))):
            return True
        if any(map(spec.HasInfo, _BRINGS)):
            return True
        waiting += spec.nameChildren
        for variant_set in spec.variantSets.values():
            waiting += (inner.primSpec for inner in variant_set.variants.values())
    return False
