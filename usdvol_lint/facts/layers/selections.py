"""Variant selections that name no variant, where some variant of the set has to do with us."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator
from itertools import chain, islice
from typing import Any, NamedTuple

from usdvol_lint import schema
from usdvol_lint.facts.layers.words import speak_of_ours
from usdvol_lint.facts.usd.calls import ARCS, get_path, get_prim_stack, has_metadata
from usdvol_lint.facts.usd.drawn import Drawn
from usdvol_lint.facts.usd.instances import in_prototype
from usdvol_lint.facts.usd.kinds import PrimKinds
from usdvol_lint.nearest import is_one_slip_from

_SELECTION = "variantSelection"
_GENERAL = frozenset(
    {
        *("doubleSided", "extent", "orientation", "purpose", "visibility", "xformOpOrder"),
        *("primvars:displayColor", "primvars:displayOpacity"),
    }
)
_OWN = frozenset(chain.from_iterable(schema.ATTRIBUTES.values())) - _GENERAL
"""The attributes that no other schema has."""
_MOST_SPECS = 10_000


class WrongSelection(NamedTuple):
    """A selection that selects nothing.

    `known`: the variants of the set; empty where the prim has no such set.
    `similar`: the one of them, or the set, that was probably meant; None if none is near.
    `copies` counts the prims of the stage that have it from this spec.
    """

    prim: Any
    spec: Any
    set_name: str
    variant: str
    known: tuple[str, ...]
    similar: str | None
    copies: int


def wrong_selections(
    prims: Iterable[Any], drawn: Drawn, kinds: PrimKinds, may_lack: Callable[[Any], bool]
) -> Iterator[WrongSelection]:
    """What is selected on these prims and is not there, though ours may be in that set.

    `may_lack` says whether opinions on a prim may lie in a layer that does not open.
    """
    found: dict[Any, list[WrongSelection]] = defaultdict(list)
    for prim in sorted(set(prims), key=get_path):
        if has_metadata(prim, _SELECTION) and in_prototype(prim) in drawn:
            for wrong in _wrong(prim, kinds):
                found[wrong.spec, wrong.set_name].append(wrong)
    for first, *others in found.values():
        if not may_lack(first.prim):
            yield first._replace(copies=1 + len(others))


def _wrong(prim: Any, kinds: PrimKinds) -> Iterator[WrongSelection]:
    names = dict.fromkeys(prim.GetVariantSets().GetNames())
    selected = prim.GetVariantSets().GetAllVariantSelections()
    authored, sets = _authored(prim), _variant_sets(prim)
    for set_name, variant in selected.items():
        known: tuple[str, ...] = ()
        if set_name in names:
            known = _variants(sets.get(set_name, ()))
            similar, concerned = _near(variant, known), set_name
        else:
            unselected = (each for each in names if not selected.get(each))
            similar = _near(set_name, unselected)
            concerned = similar or ""
        spec = authored.get((set_name, variant))
        if (
            variant
            and variant not in known
            and spec
            and concerned
            and _has_ours(sets.get(concerned, ()), kinds)
        ):
            yield WrongSelection(prim, spec, set_name, variant, known, similar, 1)


def _variant_sets(prim: Any) -> dict[str, list[Any]]:
    """The specs of each variant set of a prim, strongest first.

    USD looks through all sets for the variants of each.
    """
    found: dict[str, list[Any]] = defaultdict(list)
    for spec in get_prim_stack(prim):
        for name, variant_set in spec.variantSets.items():
            found[name].append(variant_set)
    return dict(found)


def _variants(sets: Iterable[Any]) -> tuple[str, ...]:
    """The names of the variants of a set, as each of several specs has it."""
    return tuple(sorted(set(chain.from_iterable(each.variants.keys() for each in sets))))


def _near(name: str, others: Iterable[str]) -> str | None:
    near = [other for other in others if is_one_slip_from(name, other)]
    return near[0] if len(near) == 1 else None


def _authored(prim: Any) -> dict[tuple[str, str], Any]:
    """The strongest spec with each selection, by set and variant; what no layer says has none."""
    found: dict[tuple[str, str], Any] = {}
    for spec in get_prim_stack(prim):
        if spec.HasInfo(_SELECTION):
            for selection in spec.GetInfo(_SELECTION).items():
                found.setdefault(selection, spec)
    return found


def _has_ours(sets: Iterable[Any], kinds: PrimKinds) -> bool:
    """Whether a variant of a set has prims or properties of ours, or names that speak of them."""
    return any(_is_ours(spec, kinds) for spec in islice(_specs(sets), _MOST_SPECS))


def _specs(sets: Iterable[Any]) -> Iterator[Any]:
    """The specs in the variants of a set, as each of several specs has it."""
    variants = chain.from_iterable(each.variants.values() for each in sets)
    waiting = [each.primSpec for each in variants]
    while waiting:
        spec = waiting.pop()
        yield spec
        waiting += spec.nameChildren
        for inner in spec.variantSets.values():
            waiting += (each.primSpec for each in inner.variants.values())


def _is_ours(spec: Any, kinds: PrimKinds) -> bool:
    if not schema.OURS.isdisjoint(kinds.names((spec.typeName,))):
        return True
    names = spec.properties.keys()
    if any(name in _OWN or name.startswith(schema.FIELD_NAMESPACE) for name in names):
        return True
    items = chain.from_iterable(
        spec.GetInfo(arc).GetAppliedItems() for arc in filter(spec.HasInfo, ARCS)
    )
    return speak_of_ours(map(str, items))
