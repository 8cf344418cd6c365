"""Whether the extent of a particle field encloses its positions at the same time."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from math import inf
from typing import Any, ClassVar

from usdvol_lint.facts.particles import matches
from usdvol_lint.facts.particles.array import ArraySample, ParticleArray
from usdvol_lint.facts.particles.arrays import ParticleArrays
from usdvol_lint.facts.particles.elements import Elements, as_text
from usdvol_lint.facts.particles.matches import Mask
from usdvol_lint.facts.particles.ranges import column_range
from usdvol_lint.facts.particles.statistics import INVISIBLE
from usdvol_lint.facts.particles.unseen import hidden_while
from usdvol_lint.facts.prims.boxes import encloses, union
from usdvol_lint.facts.prims.extents import box_of
from usdvol_lint.facts.usd.steps import Time
from usdvol_lint.facts.usd.values import sample_times
from usdvol_lint.volumefile import Bounds

_HALF_STEP = 2.0**-24
"""The distance of halfs next to zero, where their rounding error is absolute."""


@dataclass(frozen=True, slots=True)
class OutsideExtent:
    """Positions outside the extent, which is `attribute`.

    `elements` are the positions, `all_times` the times at which some are outside; `extent` is its
    value at the first of these, `positions` the box around those of all samples that can be seen.
    """

    elements: Elements
    attribute: Any
    all_times: tuple[Time, ...]
    extent: Bounds
    positions: Bounds
    asset: ClassVar[None] = None

    @property
    def times(self) -> tuple[float, ...]:
        return tuple(time for time in self.all_times if time is not None)

    @property
    def at_default(self) -> bool:
        return None in self.all_times

    @property
    def shown_extent(self) -> str:
        return _shown(self.extent)

    @property
    def shown_positions(self) -> str:
        return _shown(self.positions)

    def shown_with(self, box: Bounds) -> str:
        """A box around the positions and another box."""
        return _shown(union([self.positions, box]))


def positions_outside_extent(
    arrays: ParticleArrays, extent: Any, slack: float, clamp: float
) -> OutsideExtent | None:
    """The positions outside the extent by more than `slack` times its largest coordinate.

    That is taken along each axis.  A side at `clamp`, or at its negative, was cut off by an
    exporter, and sets no limit; a particle that can't be seen there may lie anywhere.
    """
    positions = next(arrays.used("positions"))
    all_times: list[Time] = []
    boxes: dict[Time, Bounds] = {}
    spans: list[Bounds] = []
    for sample, measured in positions.ranges:
        if not measured.low or not measured.high:
            continue
        span: Bounds | None = _box(measured.low, measured.high)
        is_narrowed = False
        for time in times_of_extent(positions, sample, extent):
            box = box_of(extent.Get() if time is None else extent.Get(time))
            if not box or _holds(box, span, slack, clamp, positions):
                continue
            if not is_narrowed:
                span, is_narrowed = _seen_span(arrays, positions, sample, span), True
            if not _holds(box, span, slack, clamp, positions):
                all_times.append(time)
                boxes.setdefault(sample.time, box)
        spans += [span] if span else []
    if not boxes:
        return None
    makers = {
        time: _outside(limits_of(box, slack, clamp, positions.is_half), arrays, positions)
        for time, box in boxes.items()
    }
    elements = positions.selected(makers)
    if not elements:
        return None
    first = elements.samples[0].time
    return OutsideExtent(elements, extent, tuple(all_times), boxes[first], union(spans))


def _holds(
    box: Bounds, span: Bounds | None, slack: float, clamp: float, positions: ParticleArray
) -> bool:
    """Whether an extent encloses the bounds of positions; None are those of no position."""
    return not span or encloses(limits_of(box, slack, clamp, positions.is_half), span, 0.0)


def _seen_span(
    arrays: ParticleArrays, positions: ParticleArray, sample: ArraySample, span: Bounds | None
) -> Bounds | None:
    """The bounds of the positions in a sample whose particles can be seen, within its `span`."""
    hidden = hidden_while(arrays, positions, sample, INVISIBLE)
    if not hidden.any():
        return span
    for _, rows in positions.read(lambda own: own is sample):
        seen = rows[~hidden]
        measured = column_range(seen) if len(seen) else None
        if measured and measured.low and measured.high:
            return _box(measured.low, measured.high)
    return None


def times_of_extent(positions: ParticleArray, sample: ArraySample, extent: Any) -> Iterable[Time]:
    """When the extent has to enclose a sample: always, for positions that are not animated."""
    return (positions.total < 2 and sample_times(extent)) or [sample.time]


def limits_of(box: Bounds, slack: float, clamp: float, is_half: bool) -> Bounds:
    """An extent widened by its slack along each axis, and without limit where it was cut off."""
    step = _HALF_STEP if is_half else 0.0
    low, high = box
    margins = [max(map(abs, sides)) * slack + step for sides in zip(low, high, strict=True)]
    return _box(
        [-inf if end == -clamp else end - by for end, by in zip(low, margins, strict=True)],
        [inf if end == clamp else end + by for end, by in zip(high, margins, strict=True)],
    )


def _box(low: Sequence[float], high: Sequence[float]) -> Bounds:
    (a, b, c), (x, y, z) = low, high
    return (a, b, c), (x, y, z)


def _outside(
    limits: Bounds, arrays: ParticleArrays, positions: ParticleArray
) -> Callable[[ArraySample], Mask]:
    """Makes the mask of a sample that selects what is outside of the limits and can be seen."""

    def make(sample: ArraySample) -> Mask:
        seen = ~hidden_while(arrays, positions, sample, INVISIBLE)
        return lambda chunk, start: (
            matches.outside(chunk, *limits) & seen[start : start + len(chunk)]
        )

    return make


def _shown(box: Bounds) -> str:
    return f"{as_text(box[0])} to {as_text(box[1])}"
