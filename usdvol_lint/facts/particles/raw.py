"""Whether numbers are those of a PLY file: logits for opacities, logarithms for scales."""

from __future__ import annotations

from usdvol_lint.facts.particles.array import ParticleArray
from usdvol_lint.facts.particles.elements import Elements


def are_logits(array: ParticleArray, outside: Elements | None) -> bool:
    """Whether opacities look like logits, which rarely leave -15 to 15.

    `outside` are those outside of 0 to 1.
    """
    span = array.span
    return span is not None and span[0] > -100 and span[1] < 32 and _are_most(array, outside)


def are_logarithms(array: ParticleArray, negative: Elements | None) -> bool:
    """Whether scales look like logarithms; `negative` are those with a number below 0."""
    span = array.span
    return span is not None and span[0] > -50 and span[1] < 20 and _are_most(array, negative)


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
