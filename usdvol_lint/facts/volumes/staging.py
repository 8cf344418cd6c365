"""What moves the picture of a field whose file is held: its placement, and when it is visible."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

from pxr import UsdGeom

from usdvol_lint.facts.layers.turns import changes_place
from usdvol_lint.facts.usd.instances import shown


class Staging(NamedTuple):
    """How prims are shown over a range of time.

    `is_shown`: whether one of them is visible for more than a frame; `is_still`: whether one is so
    throughout, and stays where it is.
    """

    is_shown: bool
    is_still: bool


def staging_of(
    field: Any, volumes: Sequence[Any], moved: Collection[Any], time_range: tuple[float, float]
) -> Staging:
    """How the Volumes that use a field are shown, or else the field itself.

    `moved` are the paths of what PointInstancers move.
    """
    each = [_staging(prim, moved, time_range) for prim in volumes or (field,)]
    is_still = any(map(all, each)) and not any(map(changes_place, _upwards(field)))
    return Staging(any(one.is_shown for one in each), is_still)


def _staging(prim: Any, moved: Collection[Any], time_range: tuple[float, float]) -> Staging:
    prim = prim.GetStage().GetPrimAtPath(shown(prim).path)
    upwards = list(_upwards(prim))
    changes = sorted({time for each in upwards for time in _changes(each)})
    imageable = UsdGeom.Imageable(prim)
    is_visible = [
        (start, end)
        for start, end in pairwise(_within(changes, time_range))
        if imageable.ComputeVisibility(start) != UsdGeom.Tokens.invisible
    ]
    is_moved = any(each.GetPath() in moved or changes_place(each) for each in upwards)
    return Staging(sum(end - start for start, end in is_visible) > 1, not changes and not is_moved)


def _upwards(prim: Any) -> Iterator[Any]:
    while prim and not prim.IsPseudoRoot():
        yield prim
        prim = prim.GetParent()


def _changes(prim: Any) -> Sequence[float]:
    """The times at which a prim may become visible or invisible."""
    imageable = UsdGeom.Imageable(prim)
    attribute = imageable.GetVisibilityAttr() if imageable else None
    times: Sequence[float] = attribute.GetTimeSamples() if attribute else ()
    return times if len(times) > 1 else ()


def _within(times: Iterable[float], time_range: tuple[float, float]) -> list[float]:
    """The times in a range, with its start and the frame after its end."""
    start, end = time_range
    return [start, *(time for time in times if start < time <= end), end + 1]
