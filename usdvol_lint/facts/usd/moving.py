"""What moves the samples of a sequence to where they are on the stage, and what would move them."""

from __future__ import annotations

import math
from typing import Any

from usdvol_lint.facts.usd.opinions import is_from_clips, strongest_opinion
from usdvol_lint.words import format_time


def advice_on_shift(attribute: Any, first: float, shift: float) -> str:
    """How to move samples that begin at `first`, wherever they are authored."""
    by = format_time(shift)
    if is_from_clips(attribute, first):
        return (
            f"move the clips by {by}: active and times of their set, or the layer offset of what "
            "brings it"
        )
    opinion = strongest_opinion(attribute, first)
    if opinion and opinion.spec.layer == attribute.GetStage().GetRootLayer():
        return f"change their times by {by}: no layer offset moves the stage's own layer"
    return f"move them by {by} with the layer offset of the sublayer, reference or payload"


def rate_at_fault(
    attribute: Any, ends: tuple[float, float], step: float, time_range: tuple[float, float]
) -> str | None:
    """The scale by which USD makes up for another rate, in words, if samples fit without it.

    `ends`: the first and the last sample.  A sample holds until the next would come.
    """
    opinion = strongest_opinion(attribute, ends[0])
    if opinion is None or is_from_clips(attribute, ends[0]):
        return None
    offset, layer = opinion.offset, opinion.spec.layer
    rate, own = attribute.GetStage().GetTimeCodesPerSecond(), layer.timeCodesPerSecond
    if rate == own or not math.isclose(offset.scale, rate / own, rel_tol=1e-6):
        return None
    first, last = (offset.offset + (end - offset.offset) / offset.scale for end in ends)
    slack = step / offset.scale - 1e-6
    if first - time_range[0] > slack or time_range[1] - last > slack:
        return None
    return (
        f"the layer says {format_time(own)} time codes per second, the stage {format_time(rate)}, "
        f"so USD scales times by {format_time(offset.scale)}: correct the rate that is wrong"
    )
