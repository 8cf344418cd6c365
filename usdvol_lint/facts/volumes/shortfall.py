"""By how much an extent is too small: compared with each grid at each time."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache
from typing import Any, ClassVar, NamedTuple

from usdvol_lint.cached import cached_property
from usdvol_lint.facts.files.assets import AssetSamples
from usdvol_lint.facts.files.states import AssetState
from usdvol_lint.facts.grids.timelines import Timeline
from usdvol_lint.facts.prims.boxes import (
    AXES,
    Sides,
    encloses,
    extent_around,
    magnitude,
    sides_outside,
    union,
)
from usdvol_lint.facts.prims.extents import Limits
from usdvol_lint.facts.usd.steps import StepSamples, Time
from usdvol_lint.facts.volumes.hulls import GridBoxes, bounds_in_volume
from usdvol_lint.facts.volumes.placement import Placement
from usdvol_lint.facts.volumes.targets import Target
from usdvol_lint.volumefile import Bounds, Grid, Matrix
from usdvol_lint.volumefile.transform import IDENTITY
from usdvol_lint.words import format_time, quoted

_MOST_SAMPLES = 6
_STATEMENT = "float3[] extent = "
_BEYOND_FLOAT = 1e38
_OUT_OF_REACH = "export the grid again: its transform takes it further than an extent can reach"


class Moment(NamedTuple):
    """A grid at a time, and the matrix from its world space to the space of the Volume."""

    time: Time
    grid: Grid
    matrix: Matrix


class PlacedField:
    """A field of a Volume: the grids in its files over time, and its placement.

    `shown_at` is a path of the Volume if several instances show it without the field; else empty.
    """

    def __init__(
        self,
        target: Target,
        paths: AssetSamples,
        timeline: Timeline,
        placement: Placement,
        shown_at: str,
    ) -> None:
        self._target = target
        self._paths, self._timeline = paths, timeline
        self._placement = placement
        self.shown_at = shown_at
        self._transform_times = placement.times

    @property
    def shown(self) -> str:
        """The path of the field as the stage shows it."""
        return self._target.shown

    @property
    def opinions(self) -> tuple[Any, ...]:
        """The attributes that say which grids there are, and where they are placed."""
        path = self._paths.attribute
        names = map(path.GetPrim().GetAttribute, ("fieldName", "fieldIndex"))
        return (path, *names, *self._placement.attributes)

    def has_known_grids(self, boxes: GridBoxes) -> bool:
        """Whether each file was looked into, and has the grid, whose box and place are known."""
        samples = self._paths.samples
        named = [sample.time for sample in samples if sample.state is not AssetState.BLOCKED]
        return all(
            moment and (moment.grid.is_empty or boxes.whole(moment.grid, moment.matrix))
            for moment in map(self.at, (*named, *self._transform_times))
        )

    def moments(self, more_times: Iterable[float]) -> Iterator[Moment]:
        """The moments at which grid or placement change, and those at `more_times`.

        A moment without grid or matrix is left out, and so is the default time of an animated
        placement.
        """
        times: list[Time] = [] if self._transform_times else [None]
        times += sorted({*self._grids.times, *self._transform_times, *more_times})
        yield from filter(None, map(self.at, times))

    def at(self, time: Time) -> Moment | None:
        """Grid and matrix at a time, if there are both."""
        grid = self._grids.at(time)
        matrix = self._matrix(time if self._transform_times else None) if grid else None
        return Moment(time, grid, matrix) if grid and matrix else None

    @cached_property
    def _grids(self) -> StepSamples[Grid | None]:
        """The grid that the field names at each sample; None where it was not found."""
        grids: dict[Time, Grid | None] = {sample.time: None for sample in self._paths.samples}
        grids.update(self._timeline.grids())
        return StepSamples(
            sorted(grids.items(), key=lambda item: (item[0] is not None, item[0] or 0.0))
        )

    @cached_property
    def _matrix(self) -> Callable[[Time], Matrix | None]:
        return cache(self._placement.matrix)


class Overhang(NamedTuple):
    """How far a grid sticks out of the extent at one time, and on which sides."""

    field: str
    grid: str
    sides: Sides
    time: Time
    is_displaced: bool
    shown_at: str

    @property
    def most(self) -> float:
        return max(amount for _, amount in self.sides)

    @property
    def least(self) -> float:
        return min(amount for _, amount in self.sides)

    @property
    def amounts(self) -> str:
        """As in `0.1 on -x, +x; 0.25 on +z`."""
        sides: dict[str, list[str]] = {}
        for side, amount in self.sides:
            sides.setdefault(f"{amount:.4g}", []).append(side)
        if len(sides) == 1 and len(self.sides) == 2 * AXES:
            return f"{next(iter(sides))} on every side"
        return "; ".join(f"{amount} on {', '.join(names)}" for amount, names in sides.items())

    @property
    def shown(self) -> str:
        """The grid as messages name it."""
        moved = ", moved as its field is," if self.is_displaced else ""
        moved += f" in <{self.shown_at}>" if self.shown_at else ""
        return f"the grid {quoted(self.grid)} of <{self.field}>{moved}"


@dataclass(frozen=True, slots=True)
class Shortfall:
    """An authored extent that is too small, and the grid that sticks out of it furthest.

    `fields` are those with a grid that sticks out; `checked` counts the times that were compared;
    `times` and `at_default` are those at which the extent is too small.
    `against` are the attributes that place the grids.
    `remedy` says which extent encloses the whole voxels: an animated one at the times at which it
    is too small, if these are few, else one for all times.
    """

    attribute: Any
    worst: Overhang
    fields: frozenset[str]
    times: tuple[float, ...]
    at_default: bool
    checked: int
    only_half_voxels: bool
    remedy: str
    against: tuple[Any, ...]
    asset: ClassVar[None] = None

    @property
    def is_of_empty_extent(self) -> bool:
        """Whether the extent is USD's empty range, which encloses nothing."""
        return len(self.worst.sides) == 2 * AXES and self.worst.least > _BEYOND_FLOAT

    @property
    def count(self) -> str:
        """In words how many times and fields this concerns; empty for one of each."""
        words = []
        if len(self.times) > 1 and self.worst.time is not None:
            words.append(f"worst at frame {format_time(self.worst.time)}")
        if self.checked > 1:
            default = ", the default time among them" if self.at_default else ""
            times = len(self.times) + self.at_default
            words.append(f"at {times} of {self.checked} times{default}")
        if len(self.fields) > 1:
            words.append(f"in {len(self.fields)} fields")
        return f" ({', '.join(words)})" if words else ""


def find_shortfall(
    limits: Limits, fields: Sequence[PlacedField], boxes: GridBoxes, relative_slack: float
) -> Shortfall | None:
    """Compares an extent with every grid, at every time at which one of them changes.

    A box may stick out by `relative_slack` times its largest coordinate.
    If a voxel centre is outside, half-voxel overhangs elsewhere are not reported.
    """
    checked: set[Time] = set()
    centres, halves = _Tally(checked), _Tally(checked)
    for placed in fields:
        for moment in placed.moments(limits.times):
            limit, whole = limits.at(moment.time), boxes.whole(moment.grid, moment.matrix)
            if limit is None or whole is None:
                continue
            checked.add(moment.time)
            slack = relative_slack * magnitude(whole)
            if not encloses(limit, whole, slack):
                inner = bounds_in_volume(moment.grid, moment.matrix, 0.0)
                if inner and (sides := sides_outside(limit, inner, slack)):
                    centres.add(placed, moment, sides, whole)
                else:
                    halves.add(placed, moment, sides_outside(limit, whole, slack), whole)
    tally = centres if centres.worst else halves
    if tally.worst is None:
        return None
    return Shortfall(
        attribute=limits.attribute,
        worst=tally.worst,
        fields=frozenset(tally.fields),
        times=tally.timed,
        at_default=None in tally.times and len(checked) > 1,
        checked=len(checked),
        only_half_voxels=tally is halves,
        remedy=_remedy(limits, fields, boxes, tally),
        against=tuple(
            each for placed in fields if placed.shown in tally.fields for each in placed.opinions
        ),
    )


@dataclass(slots=True)
class _Tally:
    """What sticks out of the extent, over all fields and times, of those that were `checked`."""

    checked: set[Time]
    times: set[Time] = field(default_factory=set)
    fields: set[str] = field(default_factory=set)
    worst: Overhang | None = None
    reach: float = 0.0
    """How far from the origin the boxes reach."""

    @property
    def timed(self) -> tuple[float, ...]:
        return tuple(sorted(time for time in self.times if time is not None))

    def add(self, placed: PlacedField, moment: Moment, sides: Sides, whole: Bounds) -> None:
        self.times.add(moment.time)
        self.fields.add(placed.shown)
        self.reach = max(self.reach, magnitude(whole))
        displaced = moment.matrix is not IDENTITY
        overhang = Overhang(
            placed.shown, moment.grid.label, sides, moment.time, displaced, placed.shown_at
        )
        if self.worst is None or overhang.most > self.worst.most:
            self.worst = overhang


def _remedy(limits: Limits, fields: Sequence[PlacedField], boxes: GridBoxes, tally: _Tally) -> str:
    """The extents to write: at the times in question, for samples hide a default, or for all."""
    if tally.reach > _BEYOND_FLOAT:
        return _OUT_OF_REACH
    if not limits.times or len(tally.times) > _MOST_SAMPLES:
        instead = " in the place of the time samples" if limits.times else ""
        return f"write '{fitting(fields, boxes, limits.times)}'{instead}"
    is_interpolated = not tally.checked - {None} <= set(limits.times)
    samples = []
    for time in sorted(tally.times, key=lambda time: (time is not None, time or 0.0)):
        moments = (moment for placed in fields if (moment := placed.at(time)))
        wholes = list(filter(None, (boxes.whole(grid, matrix) for _, grid, matrix in moments)))
        held = limits.at(time) if is_interpolated else None
        box = extent_around([*wholes, held] if held else wholes)  # what lies between stays enclosed
        samples.append(f"'{_STATEMENT if time is None else f'{format_time(time)}: '}{box}'")
    return f"write {', '.join(samples)}"


def fitting_all(fields: Sequence[PlacedField], boxes: GridBoxes) -> str | None:
    """The same, if the grids are known at all times, have voxels, and an extent can reach them."""
    if not all(field.has_known_grids(boxes) for field in fields):
        return None
    wholes = list(_wholes(fields, boxes))
    is_within_reach = bool(wholes) and magnitude(union(wholes)) <= _BEYOND_FLOAT
    return fitting(fields, boxes) if is_within_reach else None


def fitting(fields: Sequence[PlacedField], boxes: GridBoxes, times: Iterable[float] = ()) -> str:
    """The statement of an extent that encloses all grids at all times, also at these."""
    return _STATEMENT + extent_around(_wholes(fields, boxes, times))


def _wholes(
    fields: Sequence[PlacedField], boxes: GridBoxes, times: Iterable[float] = ()
) -> Iterator[Bounds]:
    """The boxes of all grids at all times, also at these."""
    moments = (moment for placed in fields for moment in placed.moments(times))
    yield from filter(None, (boxes.whole(grid, matrix) for _, grid, matrix in moments))
