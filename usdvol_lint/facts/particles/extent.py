"""Positions of particles held against the extent at the same time."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, ClassVar, TypeAlias

from usdvol_lint.facts.particles import memory
from usdvol_lint.facts.particles.array import Found, ParticleArray, Sample, written
from usdvol_lint.facts.particles.memory import Mask, Row
from usdvol_lint.facts.prims.extents import box_of
from usdvol_lint.facts.usd.steps import Time
from usdvol_lint.facts.usd.values import sample_times

Box: TypeAlias = tuple[Row, Row]

_INFINITY = float("inf")
_HALF_STEP = 2.0**-24
"""Between halfs next to zero, where their error is not relative any more."""


@dataclass(frozen=True, slots=True)
class Strays:
    """Positions outside the extent; `when` are the times at which it does not hold them all.

    `extent` is the first of these, `positions` what all positions span.
    """

    found: Found
    attribute: Any
    """The extent."""
    when: tuple[Time, ...]
    extent: Box
    positions: Box
    asset: ClassVar[None] = None

    @property
    def times(self) -> tuple[float, ...]:
        return tuple(time for time in self.when if time is not None)

    @property
    def at_default(self) -> bool:
        return None in self.when

    @property
    def shown_extent(self) -> str:
        return _shown(self.extent)

    @property
    def shown_positions(self) -> str:
        return _shown(self.positions)


def positions_outside_extent(
    positions: ParticleArray, extent: Any, slack: float, clamp: float
) -> Strays | None:
    """The positions outside the extent by more than a share of its coordinates.

    A coordinate of `clamp`, or its negative, is where an exporter cut the extent off.
    """
    when: list[Time] = []
    boxes: dict[Time, Box] = {}
    masks: dict[Time, Mask] = {}
    for sample, found in positions.ranges:
        for time in _times_of_extent(positions, sample, extent):
            box = box_of(extent.Get() if time is None else extent.Get(time))
            if not box or not found.low or not found.high:
                continue
            limits = _limits(box, slack, clamp, positions.is_half)
            if not _encloses(limits, (found.low, found.high)):
                when.append(time)
                boxes.setdefault(sample.time, box)
                masks.setdefault(sample.time, _outside(limits))
    strays = positions.picked(masks) if masks else None
    if not strays or not positions.low or not positions.high:
        return None
    first = strays.samples[0].time
    return Strays(strays, extent, tuple(when), boxes[first], (positions.low, positions.high))


def _times_of_extent(positions: ParticleArray, sample: Sample, extent: Any) -> Iterable[Time]:
    """When the extent has to hold a sample: positions that stand still meet all of its samples."""
    return (positions.total < 2 and sample_times(extent)) or [sample.time]


def _limits(box: Box, slack: float, clamp: float, is_half: bool) -> Box:
    step = _HALF_STEP if is_half else 0.0
    margins = [max(map(abs, sides)) * slack + step for sides in zip(*box, strict=True)]
    low, high = box
    return (
        tuple(
            -_INFINITY if least == -clamp else least - margin
            for least, margin in zip(low, margins, strict=True)
        ),
        tuple(
            _INFINITY if most == clamp else most + margin
            for most, margin in zip(high, margins, strict=True)
        ),
    )


def _encloses(outer: Box, inner: Box) -> bool:
    return all(map(float.__le__, outer[0], inner[0])) and all(map(float.__ge__, outer[1], inner[1]))


def _outside(limits: Box) -> Mask:
    return lambda chunk, _: memory.outside(chunk, *limits)


def _shown(box: Box) -> str:
    return f"{written(box[0])} to {written(box[1])}"
