"""The APIs that a stronger list op takes from a particle field, and that it needs."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any, NamedTuple

from usdvol_lint import schema


class RemovedApis(NamedTuple):
    """The `names` of APIs that one spec takes away, though the prim needs them.

    `is_deletion`: whether it deletes them; otherwise its list replaces those of weaker specs.
    `listed` is what this list holds, or what else is deleted; `others` is what of ours it takes
    away besides.  `unread` are the attributes that are authored and that nobody reads without them.
    """

    spec: Any
    is_deletion: bool
    names: tuple[str, ...]
    listed: tuple[str, ...]
    others: tuple[str, ...]
    unread: tuple[str, ...]


def removed_apis(prim: Any, applied: Collection[str]) -> tuple[RemovedApis, ...]:
    """What list ops of `apiSchemas` take away for good, strongest first."""
    composed: list[str] = []
    removals = []
    for spec in reversed(prim.GetPrimStack()):
        operation = spec.GetInfo("apiSchemas")
        weaker, composed = composed, operation.ApplyOperations(composed)
        lost = [name for name in weaker if name not in composed and name in schema.API_INCLUDES]
        removals.append((spec, operation, lost))
    found = []
    for spec, operation, lost in reversed(removals):
        removed = [name for name in lost if name not in applied]
        names = tuple(name for name in removed if _is_missed(prim, name, applied))
        if names:
            items = operation.explicitItems if operation.isExplicit else operation.deletedItems
            listed = tuple(name for name in items if name not in names)
            others = tuple(name for name in removed if name not in names)
            unread = tuple(attribute for name in names for attribute in _authored(prim, name))
            found.append(RemovedApis(spec, not operation.isExplicit, names, listed, others, unread))
    return tuple(found)


def _is_missed(prim: Any, name: str, applied: Collection[str]) -> bool:
    """Whether nothing else brings what an API includes, or attributes of it are authored."""
    lacks_base = any(base not in applied for base in schema.API_INCLUDES[name])
    return lacks_base or bool(_authored(prim, name))


def _authored(prim: Any, api: str) -> list[str]:
    names = schema.API_ATTRIBUTES.get(api, ())
    return [name for name in names if prim.GetAttribute(name).HasAuthoredValue()]
