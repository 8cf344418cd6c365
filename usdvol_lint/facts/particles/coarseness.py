"""Whether the numbers that positions are made of are too coarse for particles of that size."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import inf
from operator import add
from typing import Any, NamedTuple

import numpy as np
from pxr import Usd

from usdvol_lint.facts.particles.array import ArraySample, ParticleArray
from usdvol_lint.facts.particles.arrays import ParticleArrays
from usdvol_lint.facts.particles.chunks import Row, Rows, fold, rows_of
from usdvol_lint.facts.particles.matches import rows_below
from usdvol_lint.facts.particles.ranges import joined
from usdvol_lint.facts.particles.statistics import INVISIBLE
from usdvol_lint.facts.usd.values import Value, Values

_UNIT = (1.0,) * 3
"""The scale of particles without one."""


class Counts(NamedTuple):
    """How many particles can be seen, and of how many the step exceeds the largest scale.

    `coarse`: it does; `far`: it exceeds the scale times `factor` too.
    """

    seen: int
    coarse: int
    far: int

    def plus(self, other: Counts) -> Counts:
        return Counts(*map(sum, zip(self, other, strict=True)))


@dataclass(frozen=True, slots=True)
class CoarsePositions(Values):
    """The samples of positions with numbers coarser than some particles, as `Counts`.

    `step` is the distance of neighbouring numbers at `largest`, the largest coordinate in them;
    `middle` is that of their bounds.
    """

    step: float
    largest: float
    middle: Row
    is_half: bool

    @property
    def counts(self) -> Counts:
        """Those of all samples together."""
        total = Counts(0, 0, 0)
        for counts in self:
            total = total.plus(counts)
        return total


def coarse_positions(arrays: ParticleArrays, factor: float) -> CoarsePositions | None:
    """The samples of positions whose numbers are coarser than particles that can be seen.

    Only samples whose bounds and the least scales allow that are read.
    """
    positions = next(arrays.used("positions"), None)
    if not positions:
        return None
    scales, opacities = (next(arrays.used(noun), None) for noun in ("scales", "opacities"))
    if not arrays.pairs["scales"].is_known or (scales and arrays.too_short(scales)):
        return None
    least = max((scales.low if scales else _UNIT) or _UNIT)
    samples = tuple(
        Value(sample.time, counts)
        for sample, counts in _counted(positions, scales, opacities, least, factor)
        if counts.coarse
    )
    if not samples:
        return None
    times = {sample.time for sample in samples}
    affected = [measured for sample, measured in positions.ranges if sample.time in times]
    low = joined(min, (each.low for each in affected))
    high = joined(max, (each.high for each in affected))
    if not low or not high:
        return None
    largest = max(map(abs, (*low, *high)))
    return CoarsePositions(
        positions.attribute,
        samples,
        positions.total,
        step=_step(largest, positions),
        largest=largest,
        middle=tuple((begin + end) / 2 for begin, end in zip(low, high, strict=True)),
        is_half=positions.is_half,
    )


def _counted(
    positions: ParticleArray,
    scales: ParticleArray | None,
    opacities: ParticleArray | None,
    least: float,
    factor: float,
) -> Iterator[tuple[ArraySample, Counts]]:
    """The counts of each sample whose bounds allow a step above the least scale."""
    steps = {
        sample.time: _step(max(map(abs, (*measured.low, *measured.high))), positions)
        for sample, measured in positions.ranges
        if measured.low and measured.high
    }
    for sample, rows in positions.read(lambda sample: steps.get(sample.time, -inf) > least):
        sizes, shown = (rows_at(array, sample, len(rows)) for array in (scales, opacities))
        yield sample, _count(rows, sizes, shown, steps[sample.time], factor)


def _step(number: float, positions: ParticleArray) -> float:
    """The distance to the next greater number of the same precision."""
    kind = np.float16 if positions.is_half else np.float32
    return float(np.spacing(kind(number)))


def rows_at(array: ParticleArray | None, sample: ArraySample, count: int) -> Rows | None:
    """The first elements of an array at the time of a sample; None if it has too few."""
    time = Usd.TimeCode.EarliestTime() if sample.time is None else sample.time
    value: Any = array.attribute.Get(time) if array else None
    return rows_of(value)[:count] if value is not None and len(value) >= count else None


def _count(
    positions: Rows, scales: Rows | None, opacities: Rows | None, step: float, factor: float
) -> Counts:
    """The counts of one sample; particles that can be seen are counted only if one is coarse."""

    def lost(chunk: Rows, start: int) -> tuple[int, int]:
        sizes = np.ones_like(chunk) if scales is None else scales[start : start + len(chunk)]
        small = rows_below(sizes, step)
        if not len(small):
            return 0, 0  # nearly always
        steps = np.spacing(np.abs(chunk[small]).max(axis=1)).astype(np.float32)
        largest = largest_scales(sizes[small])
        seen = _are_seen(largest, None if opacities is None else opacities[start + small])
        coarse, far = (seen & (steps > times * largest) for times in (1.0, factor))
        return int(np.count_nonzero(coarse)), int(np.count_nonzero(far))

    def visible(chunk: Rows, start: int) -> int:
        part = slice(start, start + len(chunk))
        sizes = np.ones_like(chunk) if scales is None else scales[part]
        shown = None if opacities is None else opacities[part]
        return int(np.count_nonzero(_are_seen(largest_scales(sizes), shown)))

    coarse, far = fold(positions, lost, _sums)
    return Counts(fold(positions, visible, add) if coarse else 0, coarse, far)


def _sums(one: tuple[int, int], other: tuple[int, int]) -> tuple[int, int]:
    return one[0] + other[0], one[1] + other[1]


def _are_seen(largest: Rows, opacities: Rows | None) -> Rows:
    """Which particles can be seen, from their largest scales."""
    seen: Rows = (largest > 0) & (largest < np.inf)
    return seen if opacities is None else seen & (opacities[:, 0] >= INVISIBLE)


def largest_scales(scales: Rows) -> Rows:
    """The largest scale of each particle: columns in turn are faster than `max(axis=1)`."""
    wider = scales.astype(np.float32, copy=False)
    return np.maximum(np.maximum(wider[:, 0], wider[:, 1]), wider[:, 2])
