"""By how much an extent is too small: each grid at each time, held against it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache, cached_property
from typing import Any, ClassVar, NamedTuple

from usdvol_lint.facts.files.assets import AssetSamples
from usdvol_lint.facts.grids.contents import Timeline
from usdvol_lint.facts.prims.extents import Limits
from usdvol_lint.facts.usd.steps import StepSamples, Time
from usdvol_lint.facts.volumes.bindings import Target
from usdvol_lint.facts.volumes.boxes import (
    AXES,
    Sides,
    encloses,
    extent_around,
    magnitude,
    sides_outside,
)
from usdvol_lint.facts.volumes.hulls import GridBoxes, carried
from usdvol_lint.facts.volumes.placement import Placement
from usdvol_lint.model import format_time, quoted
from usdvol_lint.volumefile import Grid, Matrix
from usdvol_lint.volumefile.transform import IDENTITY


class Moment(NamedTuple):
    """A grid at a time, and the matrix from its world space to the Volume's space."""

    time: Time
    grid: Grid
    matrix: Matrix


class PlacedField:
    """A field of a Volume: the grids that its files hold, and where it stands.

    `shown_at` is the path of the instance if there are several that show the Volume alone.
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
        self._paths = paths
        self._timeline = timeline
        self._placement = placement
        self.shown_at = shown_at
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
    def _grids(self) -> StepSamples[Grid | None]:
        """The grid that the field names at each sample; None where no file was read."""
        grids: dict[Time, Grid | None] = {sample.time: None for sample in self._paths.samples}
        grids.update(self._timeline.grids())
        return StepSamples(
            sorted(grids.items(), key=lambda item: (item[0] is not None, item[0] or 0.0))
        )

    @cached_property
    def _matrix(self) -> Callable[[Time], Matrix | None]:
        return cache(self._placement.matrix)


class Overhang(NamedTuple):
    """A grid that sticks out of the extent at one time, and how far on which sides."""

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
        """The grid in words."""
        moved = ", moved as its field is," if self.is_displaced else ""
        moved += f" in <{self.shown_at}>" if self.shown_at else ""
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
    asset: ClassVar[None] = None

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


def find_shortfall(
    limits: Limits, fields: Sequence[PlacedField], boxes: GridBoxes, relative_slack: float
) -> Shortfall | None:
    """Holds an extent against every grid at every time at which one of them changes.

    A box may stick out by `relative_slack` of its largest coordinate.
    If a voxel centre is outside, half-voxel overhangs elsewhere are not reported.
    """
    centres, halves, checked = _Tally(), _Tally(), set()
    for placed in fields:
        for moment in placed.moments(limits.times):
            limit, whole = limits.at(moment.time), boxes.whole(moment.grid, moment.matrix)
            if limit is None or whole is None:
                continue
            checked.add(moment.time)
            slack = relative_slack * magnitude(whole)
            if not encloses(limit, whole, slack):
                inner = carried(moment.grid, moment.matrix, 0.0)
                if inner and (sides := sides_outside(limit, inner, slack)):
                    centres.add(placed, moment, sides)
                else:
                    halves.add(placed, moment, sides_outside(limit, whole, slack))
    tally = centres if centres.worst else halves
    if tally.worst is None:
        return None
    return Shortfall(
        attribute=limits.attribute,
        worst=tally.worst,
        fields=len(tally.fields),
        times=tally.timed,
        at_default=None in tally.times and len(checked) > 1,
        checked=len(checked),
        only_half_voxels=tally is halves,
        fitting=_fitting(limits, fields, boxes, tally),
    )


@dataclass(slots=True)
class _Tally:
    """What sticks out, over all fields and times."""

    times: set[Time] = field(default_factory=set)
    fields: set[str] = field(default_factory=set)
    worst: Overhang | None = None

    @property
    def timed(self) -> tuple[float, ...]:
        return tuple(sorted(time for time in self.times if time is not None))

    def add(self, placed: PlacedField, moment: Moment, sides: Sides) -> None:
        self.times.add(moment.time)
        self.fields.add(placed.shown)
        displaced = moment.matrix is not IDENTITY
        overhang = Overhang(
            placed.shown, moment.grid.label, sides, moment.time, displaced, placed.shown_at
        )
        if self.worst is None or overhang.most > self.worst.most:
            self.worst = overhang


def _fitting(limits: Limits, fields: Sequence[PlacedField], boxes: GridBoxes, tally: _Tally) -> str:
    """The statement of an extent that encloses everything, or all that is there at one time."""
    if limits.times and len(tally.times) == 1:
        (time,) = tally.times
        moments = [held for each in fields if (held := each.at(time))]
        statement = "float3[] extent = " if time is None else f"{format_time(time)}: "
    else:
        moments = [moment for each in fields for moment in each.moments(limits.times)]
        statement = "float3[] extent = "
    found = (boxes.whole(grid, matrix) for _, grid, matrix in moments)
    return statement + extent_around(filter(None, found))
