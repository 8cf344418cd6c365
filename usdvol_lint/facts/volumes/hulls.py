"""Boxes around all the grids of a field: enough to tell quickly that an extent encloses them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import inf
from operator import le
from typing import Any, NamedTuple

from usdvol_lint.facts.grids.contents import Timeline
from usdvol_lint.facts.prims.extents import Limits
from usdvol_lint.facts.volumes.boxes import magnitude
from usdvol_lint.facts.volumes.placement import AT_REST, Placement
from usdvol_lint.volumefile import Bounds, Grid, IndexBounds, Matrix
from usdvol_lint.volumefile.transform import IDENTITY

_HALF_VOXEL = 0.5


class Hull(NamedTuple):
    """The union of boxes; `least_magnitude` is a lower bound of each box's largest coordinate."""

    box: Bounds
    least_magnitude: float


_NOTHING = Hull(((0.0,) * 3, (0.0,) * 3), 0.0)
"""Stands for the hull where there are no grids."""


class GridBoxes:
    """The boxes around grids, each found once."""

    def __init__(self) -> None:
        self._whole: dict[tuple[int, Matrix | None], tuple[Grid, Bounds | None]] = {}

    def whole(self, grid: Grid, matrix: Matrix) -> Bounds | None:
        """The box around the whole voxels of a grid, carried into the space of a Volume."""
        # A grid is known by its identity, which nothing else has as long as it is kept here.
        key = (id(grid), None if matrix is IDENTITY else matrix)
        if key not in self._whole:
            self._whole[key] = grid, carried(grid, matrix, _HALF_VOXEL)
        return self._whole[key][1]


class Hulls:
    """Holds extents against the hulls of grids."""

    def __init__(self, boxes: GridBoxes) -> None:
        self._boxes = boxes
        self._at_rest: dict[Timeline, Hull | None] = {}

    def overhang(self, limits: Limits, placed: Iterable[tuple[Timeline, Placement]]) -> float:
        """How far any grid may reach out of an extent, in relation to its largest coordinate.

        `placed` are the contents of the fields' files, and where the fields stand.
        Infinite where each time has to be looked at to tell.
        """
        limit = None if limits.times else limits.at(None)
        most = 0.0
        for timeline, placement in placed:
            if limit is None:
                if timeline.select_grids:
                    return inf
                continue
            known = timeline in self._at_rest
            hull = self._at_rest[timeline] if known else self._find_at_rest(timeline)
            if hull is not _NOTHING:
                if placement is not AT_REST:
                    hull = None if placement.times else self._hull(timeline, placement.matrix(None))
                if hull is None:
                    return inf
                most = max(most, _overhang(limit, hull))
        return most

    def _find_at_rest(self, timeline: Timeline) -> Hull | None:
        found = self._hull(timeline, IDENTITY) if timeline.select_grids else _NOTHING
        self._at_rest[timeline] = found
        return found

    def _hull(self, timeline: Timeline, matrix: Matrix | None) -> Hull | None:
        """The hull of all grids at all times; None where that can't be told.

        Frames mostly share a transform: then it is found in index space, for all of them at once.
        """
        if not matrix:
            return None
        frames: dict[int, tuple[Grid, list[IndexBounds]]] = {}
        for _, grid in timeline.grids():
            if grid and grid.index_bounds and grid.transform:
                frames.setdefault(id(grid.transform), (grid, []))[1].append(grid.index_bounds)
        hulls = [self._hull_of(*same, matrix) for same in frames.values()]
        if None in hulls:
            return None
        return _joined([hull for hull in hulls if hull]) if hulls else _NOTHING

    def _hull_of(self, grid: Grid, boxes: list[IndexBounds], matrix: Matrix) -> Hull | None:
        """The hull of boxes in the index space of a grid."""
        if len(boxes) == 1:
            whole = self._boxes.whole(grid, matrix)
            return Hull(whole, magnitude(whole)) if whole else None
        lows, highs = (list(zip(*corners, strict=True)) for corners in zip(*boxes, strict=True))
        outer: Any = tuple(map(min, lows)), tuple(map(max, highs))
        inner: Any = tuple(map(max, lows)), tuple(map(min, highs))
        whole = carried(grid._replace(index_bounds=outer), matrix, _HALF_VOXEL)
        shared = None
        if all(map(le, *inner)):
            shared = carried(grid._replace(index_bounds=inner), matrix, _HALF_VOXEL)
        return Hull(whole, magnitude(shared) if shared else 0.0) if whole else None


def carried(grid: Grid, matrix: Matrix, padding: float) -> Bounds | None:
    """The box around a grid's voxel centres, widened by `padding` voxels, behind a matrix."""
    return grid.world_bounds(padding, None if matrix is IDENTITY else matrix)


def _overhang(limit: Bounds, hull: Hull) -> float:
    """How far a hull sticks out at most, in relation to its magnitude."""
    (a, b, c), (d, e, f) = limit
    (x, y, z), (u, v, w) = hull.box
    if a <= x and b <= y and c <= z and u <= d and v <= e and w <= f:
        return 0.0
    most = max(a - x, b - y, c - z, u - d, v - e, w - f)
    return most / hull.least_magnitude if hull.least_magnitude else inf


def _joined(hulls: Sequence[Hull]) -> Hull:
    if len(hulls) == 1:
        return hulls[0]
    lows, highs = zip(*(hull.box for hull in hulls), strict=True)
    box: Any = tuple(map(min, zip(*lows, strict=True))), tuple(map(max, zip(*highs, strict=True)))
    return Hull(box, min(hull.least_magnitude for hull in hulls))
