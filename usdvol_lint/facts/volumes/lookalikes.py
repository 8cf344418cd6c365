"""Prims of no type, Xforms and Scopes with what makes a Volume or a splat, all but the type."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from itertools import chain
from typing import TYPE_CHECKING, Any, NamedTuple

from pxr import Usd

from usdvol_lint import schema
from usdvol_lint.facts.usd.calls import (
    WITH_INSTANCES,
    get_parent,
    get_prim_stack,
    get_property_names,
    get_type,
    has_specifier,
)
from usdvol_lint.facts.usd.instances import in_prototype
from usdvol_lint.facts.usd.unselected import may_be_said
from usdvol_lint.facts.usd.untyped import GROUP_TYPES

if TYPE_CHECKING:
    from usdvol_lint.facts.layers import Layers

_ARRAYS = (
    "positions",
    "orientations",
    "scales",
    "opacities",
    "radiance:sphericalHarmonicsCoefficients",
)


class Lookalike(NamedTuple):
    """A prim that would be a Volume for its `binding` to a field, or a splat for its arrays."""

    prim: Any
    binding: Any | None = None


def lookalikes(
    stage: Any, untyped: Iterable[Any], unbound: Collection[Any], layers: Layers
) -> list[Lookalike]:
    """By path: what would bind one of the fields at these paths, or has all the splat arrays.

    `untyped` are the prims that are in question, besides those above the fields.
    Left out are those that a variant which is not selected may give a type, those whose type is
    hidden, and those that may lack opinions.
    """
    found = {}
    for prim in chain(_above(stage, unbound), untyped):
        names = get_property_names(prim)
        binding = _binding(prim, names, unbound) if unbound and names else None
        if binding and _is_above_volume(prim):
            continue  # which may forward to it, in a variant that is not selected
        is_alike = binding or (names and _has_arrays(names))
        if is_alike and not (
            _may_be_typed(prim) or layers.may_lack(prim) or layers.hides_ours(prim)
        ):
            found[prim] = Lookalike(prim, binding)
    return sorted(found.values(), key=lambda each: each.prim.GetPath())


def _above(stage: Any, paths: Iterable[Any]) -> Iterator[Any]:
    """The drawn prims above those at these paths."""
    seen = set()
    for path in paths:
        prim = get_parent(stage.GetPrimAtPath(path))
        while has_specifier(prim) and not prim.IsPseudoRoot() and prim not in seen:
            seen.add(prim)
            if get_type(prim) in GROUP_TYPES:
                yield prim
            prim = get_parent(prim)


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
    return any(get_type(below) == schema.VOLUME for below in Usd.PrimRange(prim, WITH_INSTANCES))


def _may_be_typed(prim: Any) -> bool:
    """Whether a variant may give a prim another type: only a type said in place is stronger."""
    local = prim.GetStage().GetLayerStack()
    for spec in get_prim_stack(prim):
        if spec.typeName:
            if spec.layer in local and not spec.path.ContainsPrimVariantSelection():
                return False
            break
    return may_be_said(prim, lambda spec: bool(spec.typeName))


def _has_arrays(names: Collection[str]) -> bool:
    """Whether all arrays of a splat are authored, in single or half precision."""
    return all(name in names or f"{name}h" in names for name in _ARRAYS)
