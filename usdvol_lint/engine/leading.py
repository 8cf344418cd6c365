"""Which spec says where a relationship leads, of several that edit the list of its targets."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from usdvol_lint.engine.saying import has_value
from usdvol_lint.facts.usd.bringing import node_of
from usdvol_lint.facts.usd.calls import get_prim, get_property_stack


def leading(relationship: Any) -> Any | None:
    """The strongest spec with targets, but for those whose edits change nothing of what is wrong.

    An edit does not count where the weaker specs by themselves lead to the same targets in any
    order, or to several too where one is meant.
    """
    specs = list(filter(has_value, get_property_stack(relationship)))
    if len(specs) < 2:
        return specs[0] if specs else None  # nearly always
    prim = get_prim(relationship)
    every = _targets(prim, specs)
    for number, spec in enumerate(specs[:-1], 1):
        weaker = _targets(prim, specs[number:])
        is_edit = not spec.GetInfo("targetPaths").isExplicit
        if weaker != every and not (is_edit and len(weaker) > 1 and len(every) > 1):
            return spec
    return specs[-1]


def _targets(prim: Any, specs: Sequence[Any]) -> set[Any]:
    """The targets that specs say, strongest first, in the namespace of the prim."""
    found: set[Any] = set()
    for spec in reversed(specs):
        listed = spec.GetInfo("targetPaths")
        if listed.isExplicit:
            found = _mapped(prim, spec, listed.explicitItems)
        else:
            found -= _mapped(prim, spec, listed.deletedItems)
            found |= _mapped(prim, spec, listed.GetAppliedItems())
    return found


def _mapped(prim: Any, spec: Any, paths: Sequence[Any]) -> set[Any]:
    node = node_of(prim, spec) if paths else None
    return {node.mapToRoot.MapSourceToTarget(path) for path in paths} if node else set(paths)
