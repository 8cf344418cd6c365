"""Whether numbers are those of a PLY file: logits for opacities, logarithms for scales."""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

from usdvol_lint.facts.particles.array import ParticleArray
from usdvol_lint.facts.particles.elements import Elements

_EXPECTED = {
    "opacities": (-1e-3, 1 + 1e-3, "outside of 0 to 1"),
    "scales": (0.0, float("inf"), "below 0"),
}
_SPANS = {"opacities": (-100, 32), "scales": (-50, 20)}
"""What numbers as raw as they are in the file hardly ever leave: logits rarely leave -15 to 15."""


class RawNumbers(NamedTuple):
    """The finite numbers that are raw, in words, and all samples with such or infinite ones."""

    words: str
    at: Elements


def are_raw(array: ParticleArray, outside: Elements | None) -> bool:
    """Whether opacities look like logits or scales like logarithms.

    `outside` are the opacities outside of 0 to 1, or the scales with a number below 0.
    """
    span, (low, high) = array.span, _SPANS[array.noun]
    return span is not None and span[0] > low and span[1] < high and _are_most(array, outside)


def raw_numbers(array: ParticleArray) -> RawNumbers | None:
    """The numbers of opacities that look like logits, or of scales that look like logarithms."""
    if array.noun not in _EXPECTED:
        return None
    low, high, words = _EXPECTED[array.noun]
    outside, infinite = array.outside(low, high), array.non_finite()
    if not outside or not infinite or not array.span or not are_raw(array, outside):
        return None
    samples = {sample.time: sample for each in (outside, infinite) for sample in each.samples}
    ordered = sorted(samples.values(), key=lambda sample: (sample.time is not None, sample.time))
    least, greatest = array.span
    return RawNumbers(
        f"{outside.amount} {words}, from {least:.6g} to {greatest:.6g}",
        replace(outside, samples=tuple(ordered)),
    )


def _are_most(array: ParticleArray, elements: Elements | None) -> bool:
    """Whether elements are more than half of those that are finite, in the samples with some."""
    if not elements:
        return False
    times = {sample.time for sample in elements.samples}
    others = sum(
        measured.non_finite.count
        for sample, measured in array.ranges
        if sample.time in times and measured.non_finite
    )
    return elements.number > 0.5 * (sum(elements.sizes) - others)
