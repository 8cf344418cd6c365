"""Whether the authored extent of a Volume encloses the grids that its fields name."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache, cached_property
from math import inf
from operator import le
from typing import Any, NamedTuple, TypeAlias

from usdvol_lint.facts.files.assets import AssetSamples
from usdvol_lint.facts.grids.contents import Contents
from usdvol_lint.facts.prims.extents import Limits
from usdvol_lint.facts.usd.held import Held, Time
from usdvol_lint.facts.volumes.bindings import Target
from usdvol_lint.facts.volumes.placement import AT_REST, IDENTITY, Placement, read_placements
from usdvol_lint.model import format_time, quoted
from usdvol_lint.volumefile import Bounds, Grid, IndexBounds, Matrix

_AXES = "xyz"
_HALF_VOXEL = 0.5
_DIGITS = 6
_MOST_DECIMALS = 300


class Moment(NamedTuple):
    """A grid at a time, and the matrix from its world space to the Volume's space."""

    time: Time
    grid: Grid
    matrix: Matrix


class PlacedField:
    """A field of a Volume: the grids that its files hold, and where it stands.

    `place` is the path of the instance if there are several that show the Volume alone.
    """

    def __init__(
        self,
        target: Target,
        paths: AssetSamples,
        contents: Contents,
        placement: Placement,
        place: str,
    ) -> None:
        self._target = target
        self._paths = paths
        self._contents = contents
        self._placement = placement
        self.place = place
        self._moved_at = placement.times

    @property
    def shown(self) -> str:
        """The path of the field as the stage shows it."""
        return self._target.shown

    def moments(self, more_times: Iterable[float]) -> Iterator[Moment]:
        """Each time at which grid or placement change, and these others, where both are known.

        The default time counts only for a placement that is not animated.
        """
        times: list[Time] = [] if self._moved_at else [None]
        times += sorted({*self._grids.times, *self._moved_at, *more_times})
        yield from filter(None, map(self.at, times))

    def at(self, time: Time) -> Moment | None:
        """What holds at a time."""
        grid = self._grids.at(time)
        matrix = self._matrix(time if self._moved_at else None) if grid else None
        return Moment(time, grid, matrix) if grid and matrix else None

    @cached_property
    def _grids(self) -> Held[Grid | None]:
        """The grid that the field names at each sample; None where no file was read."""
        grids: dict[Time, Grid | None] = {sample.time: None for sample in self._paths.samples}
        grids.update(self._contents.grids())
        return Held(sorted(grids.items(), key=lambda item: (item[0] is not None, item[0] or 0.0)))

    @cached_property
    def _matrix(self) -> Callable[[Time], Matrix | None]:
        return cache(self._placement.matrix)


class Overhang(NamedTuple):
    """A grid that sticks out of the extent at one time, and how far on which sides."""

    field: str
    grid: str
    sides: tuple[tuple[str, float], ...]
    time: Time
    is_displaced: bool
    place: str

    @property
    def most(self) -> float:
        return max(amount for _, amount in self.sides)

    @property
    def amounts(self) -> str:
        """As in `0.1 on -x, +x; 0.25 on +z`."""
        sides: dict[str, list[str]] = {}
        for side, amount in self.sides:
            sides.setdefault(f"{amount:.4g}", []).append(side)
        if len(sides) == 1 and len(self.sides) == 2 * len(_AXES):
            return f"{next(iter(sides))} on every side"
        return "; ".join(f"{amount} on {', '.join(names)}" for amount, names in sides.items())

    @property
    def shown(self) -> str:
        """The grid in words."""
        moved = ", moved as its field is," if self.is_displaced else ""
        moved += f" in <{self.place}>" if self.place else ""
        return f"the grid {quoted(self.grid)} of <{self.field}>{moved}"


@dataclass(frozen=True, slots=True)
class Shortfall:
    """An authored extent that is too small, and the worst of what sticks out of it.

    `fields` is how many have a grid that does; `checked`, at how many times that was looked at.
    `fitting` is the statement of an extent that encloses the voxels whole: if the extent is
    animated and too small at a single time, for that time, else for all times.
    """

    attribute: Any
    worst: Overhang
    fields: int
    times: tuple[float, ...]
    at_default: bool
    checked: int
    only_half_voxels: bool
    fitting: str

    @property
    def is_of_empty_extent(self) -> bool:
        """Whether the extent is USD's empty range, out of which everything sticks."""
        return self.worst.most > 1e38

    @property
    def count(self) -> str:
        """Which of several times and fields are concerned; empty where there is one of each."""
        words = []
        if len(self.times) > 1 and self.worst.time is not None:
            words.append(f"most at frame {format_time(self.worst.time)}")
        if self.checked > 1:
            default = ", the default time among them" if self.at_default else ""
            times = len(self.times) + self.at_default
            words.append(f"at {times} of {self.checked} times{default}")
        if self.fields > 1:
            words.append(f"in {self.fields} fields")
        return f" ({', '.join(words)})" if words else ""


class Hull(NamedTuple):
    """A box around others; in none of these is the largest coordinate below `magnitude`."""

    box: Bounds
    magnitude: float


_NOTHING = Hull(((0.0,) * 3, (0.0,) * 3), 0.0)
"""Stands for the hull where there are no grids."""

Standing: TypeAlias = tuple[Any, Limits, Sequence[tuple[Target, AssetSamples, Contents]]]
"""A Volume with its extent, and those fields whose files have the grids that they name."""


class Enclosure:
    """Holds extents against grids; the box around each grid is found once.

    It is good for as long as contents and grids are kept.
    """

    def __init__(self) -> None:
        self._boxes: dict[tuple[int, Matrix | None], Bounds | None] = {}
        self._hulls: dict[int, Hull | None] = {}

    def overhang(self, limits: Limits, stands: Iterable[tuple[Contents, Placement]]) -> float:
        """How far any grid may reach out of the extent, in relation to its largest coordinate.

        `stands` are the contents of the fields' files, and where the fields stand.
        Infinite where each time has to be looked at to tell.
        """
        limit = None if limits.times else limits.at(None)
        most = 0.0
        for contents, placement in stands:
            if limit is None:
                if contents.select_grids:
                    return inf
                continue
            key = id(contents)
            hull = self._hulls[key] if key in self._hulls else self._hull_at_rest(contents)
            if hull is not _NOTHING:
                if placement is not AT_REST:
                    hull = None if placement.times else self._hull(contents, placement.matrix(None))
                if hull is None:
                    return inf
                most = max(most, _overhang(limit, hull))
        return most

    def _hull_at_rest(self, contents: Contents) -> Hull | None:
        found = self._hull(contents, IDENTITY) if contents.select_grids else _NOTHING
        self._hulls[id(contents)] = found
        return found

    def _hull(self, contents: Contents, matrix: Matrix | None) -> Hull | None:
        """The hull of all grids at all times; None where that can't be told.

        Frames mostly share a transform: then it is found in index space, for all of them at once.
        """
        frames: dict[int, tuple[Grid, list[IndexBounds]]] = {}
        for _, grid in contents.grids():
            if grid and grid.index_bounds and grid.transform:
                frames.setdefault(id(grid.transform), (grid, []))[1].append(grid.index_bounds)
        hulls = [self._hull_of(*same, matrix) for same in frames.values()] if matrix else [None]
        if None in hulls:
            return None
        return _joined([hull for hull in hulls if hull]) if hulls else _NOTHING

    def _hull_of(self, grid: Grid, boxes: list[IndexBounds], matrix: Matrix) -> Hull | None:
        """The hull of boxes in the index space of a grid."""
        if len(boxes) == 1:
            whole = self.whole(grid, matrix)
            return Hull(whole, _magnitude(whole)) if whole else None
        lows, highs = (list(zip(*corners, strict=True)) for corners in zip(*boxes, strict=True))
        outer: Any = tuple(map(min, lows)), tuple(map(max, highs))
        inner: Any = tuple(map(max, lows)), tuple(map(min, highs))
        whole = _carried(grid._replace(index_bounds=outer), matrix, _HALF_VOXEL)
        shared = None
        if all(map(le, *inner)):
            shared = _carried(grid._replace(index_bounds=inner), matrix, _HALF_VOXEL)
        return Hull(whole, _magnitude(shared) if shared else 0.0) if whole else None

    def shortfall(self, standing: Standing, relative_slack: float) -> Shortfall | None:
        """Holds an extent against every grid at every time at which one of them changes.

        A box may stick out by `relative_slack` of its largest coordinate.
        Once the centre of a voxel lies outside, halves of voxels elsewhere are not worth a word.
        """
        limits, fields = standing[1], list(_placed(standing))
        if not limits.are_authored or not fields:
            return None
        centres, halves = _Tally(), _Tally()
        checked = set()
        for placed in fields:
            for moment in placed.moments(limits.times):
                limit, whole = limits.at(moment.time), self.whole(moment.grid, moment.matrix)
                if limit is None or whole is None:
                    continue
                checked.add(moment.time)
                slack = relative_slack * _magnitude(whole)
                if not _encloses(limit, whole, slack):
                    inner = _carried(moment.grid, moment.matrix, 0.0)
                    if inner and (sides := _sides(limit, inner, slack)):
                        centres.add(placed, moment, sides)
                    else:
                        halves.add(placed, moment, _sides(limit, whole, slack))
        tally = centres if centres.worst else halves
        if tally.worst is None:
            return None
        times = tuple(sorted(time for time in tally.times if time is not None))
        if limits.times and len(tally.times) == 1:
            moments = [held for each in fields if (held := each.at(tally.worst.time))]
            statement = f"{format_time(times[0])}: {{}}" if times else "float3[] extent = {}"
        else:
            moments = [moment for each in fields for moment in each.moments(limits.times)]
            statement = "float3[] extent = {}"
        return Shortfall(
            attribute=limits.attribute,
            worst=tally.worst,
            fields=len(tally.fields),
            times=times,
            at_default=None in tally.times and len(checked) > 1,
            checked=len(checked),
            only_half_voxels=tally is halves,
            fitting=statement.format(
                _as_text(filter(None, (self.whole(grid, matrix) for _, grid, matrix in moments)))
            ),
        )

    def whole(self, grid: Grid, matrix: Matrix) -> Bounds | None:
        """The box around the whole voxels of a grid, carried into the space of a Volume."""
        key = (id(grid), None if matrix is IDENTITY else matrix)
        if key not in self._boxes:
            self._boxes[key] = _carried(grid, matrix, _HALF_VOXEL)
        return self._boxes[key]


def _placed(standing: Standing) -> Iterator[PlacedField]:
    volume, _, fields = standing
    for target, paths, contents in fields:
        for place, placement in read_placements(volume, target.prim):
            yield PlacedField(target, paths, contents, placement, place)


def _overhang(limit: Bounds, hull: Hull) -> float:
    """How far a hull sticks out at most, in relation to its magnitude."""
    (a, b, c), (d, e, f) = limit
    (x, y, z), (u, v, w) = hull.box
    if a <= x and b <= y and c <= z and u <= d and v <= e and w <= f:
        return 0.0
    most = max(a - x, b - y, c - z, u - d, v - e, w - f)
    return most / hull.magnitude if hull.magnitude else inf


def _joined(hulls: Sequence[Hull]) -> Hull:
    if len(hulls) == 1:
        return hulls[0]
    lows, highs = zip(*(hull.box for hull in hulls), strict=True)
    box: Any = tuple(map(min, zip(*lows, strict=True))), tuple(map(max, zip(*highs, strict=True)))
    return Hull(box, min(hull.magnitude for hull in hulls))


def _magnitude(box: Bounds) -> float:
    (a, b, c), (x, y, z) = box
    return max(abs(a), abs(b), abs(c), abs(x), abs(y), abs(z))


@dataclass(slots=True)
class _Tally:
    """What sticks out, over all fields and times."""

    times: set[Time] = field(default_factory=set)
    fields: set[str] = field(default_factory=set)
    worst: Overhang | None = None

    def add(
        self, placed: PlacedField, moment: Moment, sides: tuple[tuple[str, float], ...]
    ) -> None:
        self.times.add(moment.time)
        self.fields.add(placed.shown)
        displaced = moment.matrix is not IDENTITY
        overhang = Overhang(
            placed.shown, moment.grid.label, sides, moment.time, displaced, placed.place
        )
        if self.worst is None or overhang.most > self.worst.most:
            self.worst = overhang


def _carried(grid: Grid, matrix: Matrix, padding: float) -> Bounds | None:
    return grid.world_bounds(padding, None if matrix is IDENTITY else matrix)


def _encloses(limit: Bounds, box: Bounds, slack: float) -> bool:
    (a, b, c), (d, e, f) = limit
    (x, y, z), (u, v, w) = box
    return (
        a - slack <= x
        and b - slack <= y
        and c - slack <= z
        and u <= d + slack
        and v <= e + slack
        and w <= f + slack
    )


def _sides(limit: Bounds, box: Bounds, slack: float) -> tuple[tuple[str, float], ...]:
    """The sides on which a box sticks out, and how far."""
    (low, high), (lowest, highest) = limit, box
    amounts = {
        **{f"-{axis}": edge - end for axis, edge, end in zip(_AXES, low, lowest, strict=True)},
        **{f"+{axis}": end - edge for axis, edge, end in zip(_AXES, high, highest, strict=True)},
    }
    return tuple((side, amount) for side, amount in amounts.items() if amount > slack)


def _as_text(boxes: Iterable[Bounds]) -> str:
    """An extent around boxes, as in a layer, rounded outward to a few digits."""
    lows, highs = zip(*boxes, strict=True)
    low = [min(axis) for axis in zip(*lows, strict=True)]
    high = [max(axis) for axis in zip(*highs, strict=True)]
    magnitude = max(map(abs, (*low, *high))) or 1.0
    decimals = min(_DIGITS - 1 - math.floor(math.log10(magnitude)), _MOST_DECIMALS)
    ends = (
        [_rounded(number, decimals, math.floor) for number in low],
        [_rounded(number, decimals, math.ceil) for number in high],
    )
    return "[" + ", ".join(f"({', '.join(end)})" for end in ends) + "]"


def _rounded(number: float, decimals: int, outward: Callable[[float], int]) -> str:
    # Rounding first forgives the last bit, which would add a whole step.
    steps = outward(round(number * 10.0**decimals, 3))
    return f"{steps / 10.0**decimals + 0.0:.9g}"
