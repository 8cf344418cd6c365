"""What all numbers of an array have in common, as far as their ranges leave it open."""

from __future__ import annotations

from math import prod
from operator import add

import numpy as np

from usdvol_lint.facts.particles.array import ParticleArray
from usdvol_lint.facts.particles.chunks import READ_ONCE, Row, Rows, fold
from usdvol_lint.facts.particles.ranges import column_range, joined

_FIRST = 1024
"""How many elements are looked at before all are: most arrays differ there already."""


def mean_of(array: ParticleArray) -> float:
    """The mean of all numbers in all samples, in one pass."""
    sums = [(fold(rows, _sum, add, READ_ONCE), rows.size) for _, rows in array.read()]
    totals, sizes = zip(*sums, strict=True)
    return float(sum(totals) / sum(sizes))


def range_within(array: ParticleArray, low: float, high: float) -> tuple[Row, Row] | None:
    """The least and greatest number in each column, if all lie within the limits.

    Ends at the first sample with a number outside, or NaN, and mostly at its first elements.
    """
    lows, highs = [], []
    for _, rows in array.read():
        first = rows[:_FIRST]
        if not ((first >= low) & (first <= high)).all():
            return None
        found = column_range(rows)
        if not found.low or not found.high or found.non_finite:
            return None
        if min(found.low) < low or max(found.high) > high:
            return None
        lows.append(found.low)
        highs.append(found.high)
    least, greatest = joined(min, lows), joined(max, highs)
    return (least, greatest) if least and greatest else None


def are_whole(array: ParticleArray) -> bool:
    """Whether every number in every sample is a whole one; ends at the first sample with others."""
    return all(fold(rows, _is_whole, lambda one, other: one and other) for _, rows in array.read())


def spacing(positions: ParticleArray, count: int) -> float:
    """How far so many particles lie apart if they are spread evenly over the positions' bounds.

    An axis along which all lie at the same place does not count.
    """
    if not positions.low or not positions.high:
        return 0.0
    lengths = [end - begin for begin, end in zip(positions.low, positions.high, strict=True)]
    sides = [length for length in lengths if length > 0]
    return float((prod(sides) / count) ** (1 / len(sides))) if sides else 0.0


def _sum(chunk: Rows, start: int) -> float:
    return float(np.add.reduce(chunk, axis=None, dtype=np.float64))


def _is_whole(chunk: Rows, start: int) -> bool:
    return bool((chunk == np.rint(chunk)).all())
