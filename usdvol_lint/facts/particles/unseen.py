"""Particles that nobody can see: of no opacity, or of no size, for as long as they are there."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable
from dataclasses import dataclass
from math import inf
from typing import Any

import numpy as np

from usdvol_lint.facts.particles.array import ArraySample, ParticleArray
from usdvol_lint.facts.particles.arrays import ParticleArrays
from usdvol_lint.facts.particles.chunks import Rows
from usdvol_lint.facts.particles.elements import percent

_BEYOND = 1e-3
"""How far outside of 0 to 1 opacities are still none of logits."""


@dataclass(frozen=True, slots=True)
class Unseen:
    """Particles without opacity or size in every sample; `attribute` is the array that says it.

    `transparent` is how many are of no opacity, `sizeless` of no size, `empty` of neither;
    `selected` has one boolean for each particle.
    """

    attribute: Any
    selected: Rows
    transparent: int
    sizeless: int
    empty: int

    @property
    def words(self) -> str:
        """`2 of 3 particles (66.7 %) can't be seen: 2 of opacity 0, 1 of no size`."""
        count, total = int(np.count_nonzero(self.selected)), len(self.selected)
        reasons = (self.transparent, "of opacity 0"), (self.sizeless, "of no size along two axes")
        shares = ", ".join(f"{number:,} {reason}" for number, reason in reasons if number)
        first = f"{'the one' if count == 1 else 'first'} at [{int(self.selected.argmax())}]"
        share = percent(count / total)
        return f"{count:,} of {total:,} particles ({share}) can't be seen: {shares}, {first}"

    @property
    def lopsided_share(self) -> float:
        """The share of particles that lack one of both; a slot that is left empty lacks both."""
        return float(np.count_nonzero(self.selected) - self.empty) / len(self.selected)


def unseen_particles(arrays: ParticleArrays) -> Unseen | None:
    """The particles without opacity or size in all samples, if all are read."""
    found = [
        (array, find(lambda sample: True) if array and array.is_read_whole else _NONE)
        for array, find in _telling(arrays, 0.0)
    ]
    count = arrays.most_particles
    attributes = [array.attribute for array, rows in found if array and rows[:count].any()]
    if not attributes:
        return None
    transparent, sizeless = masks = [_of_length(count, selected) for _, selected in found]
    numbers = (int(np.count_nonzero(mask)) for mask in (*masks, transparent & sizeless))
    return Unseen(attributes[0], transparent | sizeless, *numbers)


def _of_length(count: int, selected: Rows) -> Rows:
    mask: Rows = np.zeros(count, np.bool_)
    mask[: len(selected)] = selected[:count]
    return mask


def hidden_while(
    arrays: ParticleArrays, positions: ParticleArray, sample: ArraySample, faint: float
) -> Rows:
    """Which particles can't be seen, or hardly, for as long as a sample of positions holds."""
    hidden: Rows = np.zeros(sample.size, np.bool_)
    for array, find in _telling(arrays, faint):
        if array:
            found = find(_in_force(array, positions, sample))[: sample.size]
            hidden[: len(found)] |= found
    return hidden


def _telling(
    arrays: ParticleArrays, faint: float
) -> tuple[tuple[ParticleArray | None, Callable[[Callable[[ArraySample], bool]], Rows]], ...]:
    """Opacities and scales, None where they say nothing, with what finds particles unseen by them.

    As logits, 0 is an opacity of a half; as a logarithm, it is a scale of 1.
    """
    opacities, scales = (
        next((array for array in arrays.used(noun) if not arrays.too_short(array)), None)
        for noun in ("opacities", "scales")
    )
    if opacities and not _lies_within(opacities, -_BEYOND, 1 + _BEYOND):
        opacities = None
    if scales and not _lies_within(scales, 0.0, inf):
        scales = None
    return (
        (opacities, lambda wanted: opacities.faint(faint, wanted) if opacities else _NONE),
        (scales, lambda wanted: scales.without_size(wanted) if scales else _NONE),
    )


_NONE: Rows = np.zeros(0, np.bool_)


def _lies_within(array: ParticleArray, low: float, high: float) -> bool:
    span = array.span
    return span is not None and low <= span[0] and span[1] <= high


def _in_force(
    array: ParticleArray, positions: ParticleArray, sample: ArraySample
) -> Callable[[ArraySample], bool]:
    """Selects the samples of an array from when a sample of positions holds until the next."""
    if sample.time is None:
        return lambda own: True
    times, own_times = positions.sizes.times, array.sizes.times
    place = times.index(sample.time)
    begin = sample.time if place else -inf
    end = times[place + 1] if place + 1 < len(times) else inf
    earliest = own_times[max(bisect_right(own_times, begin) - 1, 0)] if own_times else None
    if earliest is None:
        return lambda own: True
    return lambda own: own.time is not None and (own.time == earliest or begin < own.time < end)
