"""Which spec holds the value that USD gives for an attribute."""

from __future__ import annotations

from typing import Any, NamedTuple

from pxr import Tf, Usd


class Opinion(NamedTuple):
    """A spec that holds a value, and the offset from its layer's time to the stage's."""

    spec: Any
    offset: Any


def strongest_opinion(attribute: Any, time: float | None) -> Opinion | None:
    """The opinion that counts at a time code of the stage; None stands for the default time.

    Stronger specs may hold only metadata, and time samples say nothing of the default.
    """
    code = Usd.TimeCode.Default() if time is None else time
    kinds = ("default",) if time is None else ("timeSamples", "default", "spline")
    for spec, offset in _stack(attribute, code):
        if any(spec.HasInfo(kind) for kind in kinds):
            return Opinion(spec, offset)
    return None


def _stack(attribute: Any, code: Any) -> Any:
    """The specs with their offsets, strongest first, without value clips if one does not open."""
    try:
        return attribute.GetPropertyStackWithLayerOffsets(code)
    except Tf.ErrorException:
        return attribute.GetPropertyStackWithLayerOffsets(Usd.TimeCode.Default())


def is_from_clips(attribute: Any, time: float | None) -> bool:
    """Whether a value clip gives the value: then each time may have a layer of its own."""
    if time is None:
        return False
    source = attribute.GetResolveInfo(time).GetSource()
    return bool(source == Usd.ResolveInfoSourceValueClips)
