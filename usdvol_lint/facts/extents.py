"""Extents of Volumes and particle fields: every authored one, and the prims that need one."""

from __future__ import annotations

from typing import Any, NamedTuple, TypeAlias

from pxr import Usd, Vt

from usdvol_lint.facts.values import Value, Values, values_of

Corner: TypeAlias = tuple[float, float, float]


class Extent(NamedTuple):
    """One value of an `extent`: its corners if there are two, and how many elements it has."""

    size: int
    low: Corner
    high: Corner


_ORIGIN = (0.0, 0.0, 0.0)


def read_extents(attribute: Any) -> Values:
    """Every value that is an array of vectors: what else there may be is no extent to USD."""
    values = values_of(attribute)
    extents = [
        Value(time, _extent(value))
        for time, value in values.values
        if isinstance(value, Vt.Vec3fArray)
    ]
    return Values(attribute, tuple(extents), values.total)


def _extent(value: Any) -> Extent:
    if len(value) != 2:
        return Extent(len(value), _ORIGIN, _ORIGIN)
    corners: Any = memoryview(value).tolist()  # a tenth of the time that USD's own vectors take
    low, high = corners
    return Extent(2, tuple(low), tuple(high))


def has_bounds(prim: Any) -> bool:
    """Whether USD can tell the bounds of a prim: by its extent, a model's hint or a plugin."""
    if prim.GetAttribute("extent").HasAuthoredValue() or _is_hinted(prim):
        return True
    from pxr import UsdGeom  # costs start-up time, and extents are rarely missing

    boundable = UsdGeom.Boundable(prim)
    if not boundable:
        return False  # a type that this USD does not know
    computed = UsdGeom.Boundable.ComputeExtentFromPlugins(boundable, Usd.TimeCode.EarliestTime())
    return computed is not None


def _is_hinted(prim: Any) -> bool:
    """Whether a model with an `extentsHint` holds the prim wherever the stage shows it."""
    while not prim.IsPseudoRoot():
        if prim.IsModel() and prim.GetAttribute("extentsHint").HasAuthoredValue():
            return True
        if prim.IsPrototype():
            return all(_is_hinted(instance) for instance in prim.GetInstances())
        prim = prim.GetParent()
    return False
