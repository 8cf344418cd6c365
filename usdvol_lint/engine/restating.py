"""Who said something first: a spec that only says it again is not to blame for it."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from typing import Any

from pxr import Sdf

from usdvol_lint.facts.usd.calls import (
    get_parent,
    get_prim_stack,
    get_property_stack,
    is_pseudo_root,
)
from usdvol_lint.facts.usd.firsts import are_same, info
from usdvol_lint.facts.usd.instances import on_stage
from usdvol_lint.schema import SPECIFIER

VALUES, _TARGETS = ("default", "timeSamples", "spline"), ("targetPaths",)
"""The metadata in which the value of an attribute is, and of a relationship."""
_LISTS_OF_ARCS = ("references", "payload")
_LEADING = (*_LISTS_OF_ARCS, "clips")
_PATHS = (Sdf.ValueTypeNames.Asset, Sdf.ValueTypeNames.AssetArray)


def values_of(spec: Any) -> tuple[str, ...]:
    """The metadata of a property's spec in which its value is."""
    return _TARGETS if isinstance(spec, Sdf.RelationshipSpec) else VALUES


def first_with(specs: Iterable[Any], *keys: str) -> Any | None:
    """The spec that first had some metadata of those that, from the strongest on, say the same."""
    found = None
    for spec in specs:
        if not any(map(spec.HasInfo, keys)):
            continue
        if found and not _are_alike(spec, found, keys):
            break
        found = spec
    return found


def first_alike(prim: Any, spec: Any, of: object = None) -> Any:
    """The first that said all that a spec of a prim says, of one above it, or of a property.

    Where `of` is metadata of a prim's spec, it is about that alone.
    """
    path = spec.path
    if path.IsPropertyPath():
        prop = prim.GetProperty(path.name)
        stack = get_property_stack(prop) if prop else ()
        return _first_of(spec, stack, (*values_of(spec), "typeName"))
    if path == Sdf.Path.absoluteRootPath:
        return spec
    spec = spec.layer.GetPrimAtPath(path)  # a variant has a prim's spec too
    keys = (of,) if isinstance(of, str) and spec.HasInfo(of) else keys_of(spec)
    if spec not in get_prim_stack(prim):
        prim = on_stage(prim)  # of a prototype nothing is above it
    while not is_pseudo_root(prim) and spec not in get_prim_stack(prim):
        prim = get_parent(prim)
    return _first_of(spec, get_prim_stack(prim), keys) if keys else spec


def keys_of(spec: Any) -> tuple[str, ...]:
    """The metadata by which a prim's spec says something; an `over` says nothing by being one."""
    is_over = spec.specifier == Sdf.SpecifierOver
    return tuple(key for key in spec.ListInfoKeys() if not is_over or key != SPECIFIER)


def _first_of(spec: Any, stack: Sequence[Any], keys: tuple[str, ...]) -> Any:
    if len(stack) < 2 or spec not in stack:
        return spec
    return first_with(stack[stack.index(spec) :], *keys) or spec


def _are_alike(one: Any, other: Any, keys: Sequence[str]) -> bool:
    """Whether two specs say the same in some metadata."""
    if not all(are_same(_said_in(one, key), _said_in(other, key)) for key in keys):
        return False
    return not _has_paths(one, keys) or _folder(one) == _folder(other)


def _has_paths(spec: Any, keys: Sequence[str]) -> bool:
    """Whether some metadata of a spec may hold paths that lead from the folder of its layer."""
    if isinstance(spec, Sdf.PrimSpec):
        return any(spec.HasInfo(key) for key in _LEADING if key in keys)
    return isinstance(spec, Sdf.AttributeSpec) and spec.typeName in _PATHS


def _folder(spec: Any) -> str:
    return os.path.dirname(str(spec.layer.identifier))


def _said_in(spec: Any, key: str) -> Any:
    """Some metadata of a spec; of samples the times and the first one, since all may be large."""
    if key != "timeSamples" or not spec.HasInfo(key):
        said = info(spec, key)
        return _items(said) if key in _LISTS_OF_ARCS and said is not None else said
    times = spec.layer.ListTimeSamplesForPath(spec.path)
    return (*times, *(spec.layer.QueryTimeSample(spec.path, each) for each in times[:1]))


def _items(listed: Any) -> tuple[Any, ...]:
    """What a list of arcs brings, whichever operator it has; one of APIs may take others away."""
    return (tuple(listed.GetAppliedItems()), tuple(listed.deletedItems), tuple(listed.orderedItems))
