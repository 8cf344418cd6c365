"""Times of the stage at which USD gives the very sample of a layer that a retime moved there."""

from __future__ import annotations

from math import inf, nextafter
from typing import Any

from usdvol_lint.facts.usd.opinions import is_from_clips, strongest_opinion

_STEPS = 8
"""How many floating-point numbers away the time is at most that USD takes back to the sample."""


def reaching_samples(attribute: Any, times: list[float]) -> list[float]:
    """The times at which an attribute has samples, each moved by a rounding error where need be.

    From a sample to the stage and back USD rounds twice, and may end before the sample: it then
    gives the value of the one before.
    """
    opinion = strongest_opinion(attribute, times[0])
    if opinion is None or opinion.offset.IsIdentity() or is_from_clips(attribute, times[0]):
        return times
    spec, offset = opinion
    samples = spec.layer.ListTimeSamplesForPath(spec.path)
    if len(samples) != len(times):
        return times
    ordered = samples if offset.scale > 0 else samples[::-1]
    inverse = offset.GetInverse()
    return [_reaching(*pair, inverse) for pair in zip(times, ordered, strict=True)]


def _reaching(time: float, sample: float, inverse: Any) -> float:
    """The time nearest to `time` that USD takes back to the sample, or else to just after it."""
    if inverse * time == sample:
        return time
    upward = inf if inverse.scale > 0 else -inf
    after = time
    later = earlier = time
    for _ in range(_STEPS):
        later, earlier = nextafter(later, upward), nextafter(earlier, -upward)
        for each in (later, earlier):
            if inverse * each == sample:
                return each
        if inverse * after < sample:
            after = later
    return after
