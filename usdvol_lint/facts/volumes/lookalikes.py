"""Prims of no type, Xforms and Scopes with what makes a Volume or a splat, all but the type."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from itertools import chain, islice
from typing import Any, NamedTuple

from pxr import Usd

from usdvol_lint import schema
from usdvol_lint.facts.usd.calls import DRAWN_BELOW, get_parent, get_property_names, get_type
from usdvol_lint.facts.usd.drawn import Drawn
from usdvol_lint.facts.usd.instances import in_prototype

GROUP_TYPES = frozenset({"", "Xform", "Scope"})
_ARRAYS = (
    "positions",
    "orientations",
    "scales",
    "opacities",
    "radiance:sphericalHarmonicsCoefficients",
)
_SEARCHED = 20_000
"""How many prims are looked at, the first ones: more would take longer than all other rules."""


class Lookalike(NamedTuple):
    """A prim that would be a Volume for its `binding` to a field, or a splat for its arrays."""

    prim: Any
    binding: Any | None = None


def lookalikes(stage: Any, drawn: Drawn, unbound: Collection[Any]) -> list[Lookalike]:
    """By path: what would bind one of the fields at these paths, or has all the splat arrays."""
    found = {}
    groups = chain(_above(stage, unbound), _first_groups(stage, drawn))
    for prim in filter(drawn.__contains__, groups):
        names = get_property_names(prim)
        binding = _binding(prim, names, unbound) if unbound and names else None
        if binding and _is_above_volume(prim):
            continue  # which may forward to it, in a variant that is not selected
        if binding or (names and _has_arrays(names)):
            found[prim] = Lookalike(prim, binding)
    return sorted(found.values(), key=lambda each: each.prim.GetPath())


def _above(stage: Any, paths: Iterable[Any]) -> Iterator[Any]:
    """The prims above those at these paths."""
    seen = set()
    for path in paths:
        prim = get_parent(stage.GetPrimAtPath(path))
        while prim and not prim.IsPseudoRoot() and prim not in seen:
            seen.add(prim)
            if get_type(prim) in GROUP_TYPES:
                yield prim
            prim = get_parent(prim)


def _first_groups(stage: Any, drawn: Drawn) -> Iterator[Any]:
    """The first prims of the stage that have a type in question."""
    roots = (*filter(drawn.appears, stage.GetPrototypes()), *drawn.roots)
    ranges = [stage.Traverse(), *(Usd.PrimRange(root, DRAWN_BELOW) for root in roots)]
    first = islice(chain.from_iterable(ranges), _SEARCHED)
    return (prim for prim in first if get_type(prim) in GROUP_TYPES)


def _binding(prim: Any, names: Iterable[str], unbound: Collection[Any]) -> Any | None:
    """The first relationship of a prim that would bind one of these fields."""
    for name in names:
        is_binding = name.startswith(schema.FIELD_NAMESPACE)
        relationship = prim.GetRelationship(name) if is_binding else None
        if relationship:
            targets = map(prim.GetStage().GetPrimAtPath, relationship.GetForwardedTargets())
            if any(in_prototype(target).GetPath() in unbound for target in targets if target):
                return relationship
    return None


def _is_above_volume(prim: Any) -> bool:
    return any(get_type(below) == schema.VOLUME for below in Usd.PrimRange(prim, DRAWN_BELOW))


def _has_arrays(names: Collection[str]) -> bool:
    """Whether all arrays of a splat are authored, in single or half precision."""
    return all(name in names or f"{name}h" in names for name in _ARRAYS)
