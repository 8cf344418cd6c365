"""Whether the authored extent of a Volume encloses the grids that its fields name."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from pxr import Usd, Vt

from usdvol_lint.facts.assets import AssetSamples
from usdvol_lint.facts.contents import FieldContents
from usdvol_lint.facts.held import Held, Time
from usdvol_lint.facts.placement import IDENTITY, Placement
from usdvol_lint.facts.values import read_values
from usdvol_lint.model import format_time
from usdvol_lint.volumefile import Bounds, Grid, Matrix

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
    """A field of a Volume: the grids that it names, and where it stands.

    `samples` ascend in time, the default first; a grid that is None says nothing of bounds.
    """

    def __init__(
        self, shown: str, samples: Iterable[tuple[Time, Grid | None]], placement: Placement
    ) -> None:
        self.shown = shown
        self._grids = Held(samples)
        self._moved_at = placement.times
        fixed = None if placement.times else placement.matrix(None)
        self._matrix = placement.matrix if placement.times else lambda time: fixed

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
        matrix = self._matrix(time) if grid else None
        return Moment(time, grid, matrix) if grid and matrix else None


class Overhang(NamedTuple):
    """A grid that sticks out of the extent at one time, and how far on which sides."""

    field: str
    grid: str
    sides: tuple[tuple[str, float], ...]
    time: Time
    is_displaced: bool

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
        return f"the grid {self.grid!r} of <{self.field}>{moved}"


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


class Boxes:
    """The boxes around the whole voxels of grids, in the spaces of Volumes, each found once.

    They are good for as long as the grids are kept.
    """

    def __init__(self) -> None:
        self._boxes: dict[tuple[int, Matrix], Bounds | None] = {}

    def whole(self, moment: Moment) -> Bounds | None:
        key = (id(moment.grid), moment.matrix)
        if key not in self._boxes:
            self._boxes[key] = _carried(moment, _HALF_VOXEL)
        return self._boxes[key]


class Limits:
    """The authored values of an extent; a malformed one counts as none."""

    def __init__(self, attribute: Any) -> None:
        self.attribute = attribute
        self._values = {time: _bounds(value) for time, value in read_values(attribute)}
        self.times = [time for time in self._values if time is not None]
        self._get = Usd.AttributeQuery(attribute).Get if self.times else None

    @property
    def are_authored(self) -> bool:
        return any(self._values.values())

    def at(self, time: Time) -> Bounds | None:
        """The value as USD gives it: samples hide a default, and are interpolated between."""
        if time is None or self._get is None:
            return self._values.get(None)
        return self._values[time] if time in self._values else _bounds(self._get(time))


def grids_over_time(paths: AssetSamples, contents: FieldContents) -> list[tuple[Time, Grid | None]]:
    """The grid that a field names at each sample; None where it names none or no file was read."""
    grids: dict[Time, Grid | None] = {sample.time: None for sample in paths.samples}
    grids.update(contents.grids())
    return sorted(grids.items(), key=lambda item: (item[0] is not None, item[0] or 0.0))


def find_shortfall(
    limits: Limits, fields: Sequence[PlacedField], relative_slack: float, boxes: Boxes
) -> Shortfall | None:
    """Holds an extent against every grid at every time at which one of them changes.

    A box may stick out by `relative_slack` of its largest coordinate.
    Once the centre of a voxel lies outside, halves of voxels elsewhere are not worth a word.
    """
    centres, halves = _Tally(), _Tally()
    checked = set()
    for placed in fields:
        for moment in placed.moments(limits.times):
            limit, whole = limits.at(moment.time), boxes.whole(moment)
            if limit is None or whole is None:
                continue
            checked.add(moment.time)
            slack = relative_slack * max(map(abs, (*whole[0], *whole[1])))
            if not _encloses(limit, whole, slack):
                inner = _carried(moment, 0.0)
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
        fitting=statement.format(_as_text(filter(None, map(boxes.whole, moments)))),
    )


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
        overhang = Overhang(placed.shown, moment.grid.label, sides, moment.time, displaced)
        if self.worst is None or overhang.most > self.worst.most:
            self.worst = overhang


def _carried(moment: Moment, padding: float) -> Bounds | None:
    matrix = None if moment.matrix is IDENTITY else moment.matrix
    return moment.grid.world_bounds(padding, matrix)


def _bounds(value: Any) -> Bounds | None:
    if not isinstance(value, Vt.Vec3fArray) or len(value) != 2:
        return None
    low, high = value[0], value[1]
    # Indexing is many times faster than iterating over the vectors of Gf.
    a, b, c = low[0], low[1], low[2]
    x, y, z = high[0], high[1], high[2]
    ordered = -math.inf < a <= x < math.inf and -math.inf < b <= y < math.inf
    return ((a, b, c), (x, y, z)) if ordered and -math.inf < c <= z < math.inf else None


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
