"""One box around all grids of a field: a quick test whether an extent encloses them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import inf
from operator import le
from typing import Any, NamedTuple

from usdvol_lint.facts.grids.known import KnownBoxes
from usdvol_lint.facts.grids.timelines import Timeline
from usdvol_lint.facts.prims.boxes import magnitude, union
from usdvol_lint.facts.prims.extents import Limits
from usdvol_lint.facts.volumes.placement import UNTRANSFORMED, Placement
from usdvol_lint.volumefile import Bounds, Grid, IndexBounds, Matrix
from usdvol_lint.volumefile.transform import IDENTITY

_HALF_VOXEL = 0.5


class Hull(NamedTuple):
    """The union of boxes; `least_magnitude` is a lower bound of each box's magnitude."""

    box: Bounds
    least_magnitude: float


_NO_GRIDS = Hull(((0.0,) * 3, (0.0,) * 3), 0.0)
"""The hull of no grids, recognised by identity."""


class GridBoxes:
    """The boxes around grids, kept in `known`."""

    def __init__(self, known: KnownBoxes) -> None:
        self._whole = known

    def whole(self, grid: Grid, matrix: Matrix) -> Bounds | None:
        """The box around the whole voxels of a grid, in the space of a Volume."""
        # A grid has no hash; its id is unique as long as the cache keeps the grid itself.
        key = (id(grid), None if matrix is IDENTITY else matrix)
        if key not in self._whole:
            self._whole[key] = grid, bounds_in_volume(grid, matrix, _HALF_VOXEL)
        return self._whole[key][1]


class Hulls:
    """Compares extents with the hulls of grids."""

    def __init__(self, boxes: GridBoxes) -> None:
        self._boxes = boxes
        self._untransformed: dict[Timeline, Hull | None] = {}

    def overhang(self, limits: Limits, placed: Iterable[tuple[Timeline, Placement]]) -> float:
        """An upper bound on how far a grid reaches out of an extent, relative to its coordinates.

        `placed` are the files of each field over time, with the field's placement.
        Infinite where there is no such bound and each time has to be compared.
        """
        limit = None if limits.times else limits.at(None)
        most = 0.0
        for timeline, placement in placed:
            if limit is None:
                if timeline.selects_grids:
                    return inf
                continue
            cached = timeline in self._untransformed
            hull = self._untransformed[timeline] if cached else self._add_untransformed(timeline)
            if hull is not _NO_GRIDS:
                if placement is not UNTRANSFORMED:
                    hull = None if placement.times else self._hull(timeline, placement.matrix(None))
                if hull is None:
                    return inf
                most = max(most, _overhang(limit, hull))
        return most

    def _add_untransformed(self, timeline: Timeline) -> Hull | None:
        hull = self._hull(timeline, IDENTITY) if timeline.selects_grids else _NO_GRIDS
        self._untransformed[timeline] = hull
        return hull

    def _hull(self, timeline: Timeline, matrix: Matrix | None) -> Hull | None:
        """The hull of all grids at all times; None where a box can't be computed.

        The boxes of frames that share a transform are united in index space, then transformed once.
        """
        if not matrix:
            return None
        by_transform: dict[int, tuple[Grid, list[IndexBounds]]] = {}
        for _, grid in timeline.grids():
            if grid and grid.is_unmeasured:
                return None
            if grid and grid.index_bounds:
                by_transform.setdefault(id(grid.transform), (grid, []))[1].append(grid.index_bounds)
        hulls = [self._hull_of(*same, matrix) for same in by_transform.values()]
        if None in hulls:
            return None
        return _joined([hull for hull in hulls if hull]) if hulls else _NO_GRIDS

    def _hull_of(self, grid: Grid, boxes: list[IndexBounds], matrix: Matrix) -> Hull | None:
        """The hull of boxes in index space, transformed as this grid is."""
        if len(boxes) == 1:
            whole = self._boxes.whole(grid, matrix)
            return Hull(whole, magnitude(whole)) if whole else None
        lows, highs = (list(zip(*corners, strict=True)) for corners in zip(*boxes, strict=True))
        inner: Any = tuple(map(max, lows)), tuple(map(min, highs))
        whole = bounds_in_volume(grid._replace(index_bounds=union(boxes)), matrix, _HALF_VOXEL)
        shared = None
        if all(map(le, *inner)):
            shared = bounds_in_volume(grid._replace(index_bounds=inner), matrix, _HALF_VOXEL)
        return Hull(whole, magnitude(shared) if shared else 0.0) if whole else None


def bounds_in_volume(grid: Grid, matrix: Matrix, padding: float) -> Bounds | None:
    """The box around a grid's voxel centres, widened by `padding` voxels, behind its placement."""
    return grid.world_bounds(padding, None if matrix is IDENTITY else matrix)


def _overhang(limit: Bounds, hull: Hull) -> float:
    """How far a hull sticks out at most, relative to its least magnitude."""
    (a, b, c), (d, e, f) = limit
    (x, y, z), (u, v, w) = hull.box
    if a <= x and b <= y and c <= z and u <= d and v <= e and w <= f:
        return 0.0
    most = max(a - x, b - y, c - z, u - d, v - e, w - f)
    return most / hull.least_magnitude if hull.least_magnitude else inf


def _joined(hulls: Sequence[Hull]) -> Hull:
    if len(hulls) == 1:
        return hulls[0]
    box = union(hull.box for hull in hulls)
    return Hull(box, min(hull.least_magnitude for hull in hulls))
