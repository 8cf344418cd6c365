"""Whether USD can tell the bounds of a prim."""

from __future__ import annotations

from typing import Any

from pxr import Usd

from usdvol_lint.facts.usd.calls import get_attribute
from usdvol_lint.facts.usd.instances import instances_of
from usdvol_lint.facts.usd.values import read_values


def has_bounds(prim: Any) -> bool:
    """Whether USD can tell the bounds of a prim: from its extent, a model's hint, or a plugin."""
    values = read_values(get_attribute(prim, "extent"))
    if any(value is not None for _, value in values) or _is_hinted(prim):
        return True
    from pxr import UsdGeom  # costs start-up time, and is rarely needed

    boundable = UsdGeom.Boundable(prim)
    if not boundable:
        return False  # a type that this USD does not know
    computed = UsdGeom.Boundable.ComputeExtentFromPlugins(boundable, Usd.TimeCode.EarliestTime())
    return computed is not None


def _is_hinted(prim: Any) -> bool:
    """Whether a model with an `extentsHint` has the prim, through each instance of a prototype."""
    seen = set()
    waiting = [prim]
    while waiting:
        prim = waiting.pop()
        if prim.IsPseudoRoot():
            return False
        if prim in seen or (prim.IsModel() and prim.GetAttribute("extentsHint").HasAuthoredValue()):
            continue
        seen.add(prim)
        waiting += instances_of(prim) if prim.IsPrototype() else (prim.GetParent(),)
    return True
