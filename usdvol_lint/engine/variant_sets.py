"""The variant sets of a composed stage, and which variants matter to the prims that we check."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
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
"""A variant or a prim's spec in a layer: the layer's identifier, and the path in it."""
VariantsDeclared: TypeAlias = tuple[str, tuple[VariantSpec, ...]]
"""The name of a variant set, and the specs of a prim that have variants of it."""


class Survey(NamedTuple):
    """Part of the stage as it is composed now.

    `switches` are the prims with variant sets, `holders` the paths of the prims that we check and
    of all prims above them.
    """

    switches: list[Any]
    holders: set[Any]


class Variant(NamedTuple):
    """A variant of a prim; `specs` are its opinions, strongest first, each with its layer."""

    name: str
    specs: dict[VariantSpec, Any]


class _Holder(NamedTuple):
    """A spec with variants of a set: their paths in its layer, by name."""

    layer: Any
    spec: VariantSpec
    variants: Mapping[str, str]


class VariantSet(NamedTuple):
    """A variant set of a prim; `holders` are the specs with variants of it, strongest first."""

    name: str
    selected: str
    holders: Sequence[_Holder]

    @property
    def declared(self) -> VariantsDeclared:
        """What is the same for variant sets with the same variants."""
        return self.name, tuple(each.spec for each in self.holders)

    def variant(self, name: str) -> Variant:
        """A variant of the set; without specs if there is none of that name."""
        return Variant(
            name,
            {
                (spec[0], variants[name]): layer
                for layer, spec, variants in self.holders
                if name in variants
            },
        )

    def others(self) -> Iterator[Variant]:
        """The variants that are not selected."""
        names = set().union(*(each.variants for each in self.holders)) - {self.selected}
        return map(self.variant, sorted(names))


class VariantSets:
    """Reads variant sets; those of a spec once, however many selections are composed.

    Names and paths are kept, but no specs: a layer that no selection shows is closed.
    """

    def __init__(self) -> None:
        self._of_specs: dict[VariantSpec, Mapping[str, Mapping[str, str]]] = {}

    def of(self, prim: Any) -> Iterator[VariantSet]:
        """The variant sets of a prim as it is composed now."""
        held: dict[str, list[_Holder]] = defaultdict(list)
        for spec in prim.GetPrimStack():
            key = spec.layer.identifier, str(spec.path)
            if key not in self._of_specs:
                self._of_specs[key] = _variants(spec)
            for name, variants in self._of_specs[key].items():
                held[name].append(_Holder(spec.layer, key, variants))
        sets = prim.GetVariantSets()
        for name in sets.GetNames():
            yield VariantSet(name, sets.GetVariantSelection(name), held[name])


def _variants(spec: Any) -> Mapping[str, Mapping[str, str]]:
    """The paths of the variants of a spec, by set and name."""
    return {
        name: {each.name: str(each.path) for each in variant_set.variants.values()}
        for name, variant_set in spec.variantSets.items()
    }


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
