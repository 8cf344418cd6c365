"""Who said a value first: a spec that only says it again changes nothing."""

from __future__ import annotations

from typing import Any

from pxr import Sdf

from usdvol_lint.facts.usd.opinions import Opinion, opinions


def first_to_say(attribute: Any, time: float | None) -> Opinion | None:
    """The weakest of the opinions that, from the strongest on, say one value at a time.

    Without those above it the attribute has the same value.
    """
    every = opinions(attribute, time)
    if len(every) < 2:
        return every[0] if every else None  # nearly always
    strongest, *others = every
    said = _said(strongest, time)
    alike = strongest
    for opinion in others:
        other = _said(opinion, time)
        if not are_same(said, other):
            break
        alike = opinion
    return alike


def _said(opinion: Opinion, time: float | None) -> tuple[Any, ...]:
    """What an opinion says at a time of the stage, and at which times it says something."""
    spec, offset = opinion
    if time is None or not spec.HasInfo("timeSamples"):
        return info(spec, "spline"), anchored(spec, spec.default)
    layer, path = spec.layer, spec.path
    _, before, _ = layer.GetBracketingTimeSamplesForPath(path, offset.GetInverse() * time)
    times = tuple(offset * each for each in layer.ListTimeSamplesForPath(path))
    return times, anchored(spec, layer.QueryTimeSample(path, before))


def anchored(spec: Any, value: Any) -> Any:
    """A value of a spec; paths as its layer takes them."""
    if isinstance(value, Sdf.AssetPathArray):
        return tuple(anchored(spec, each) for each in value)
    is_path = isinstance(value, Sdf.AssetPath)
    return spec.layer.ComputeAbsolutePath(value.path) if is_path and value.path else value


def info(spec: Any, key: str) -> Any:
    return spec.GetInfo(key) if spec.HasInfo(key) else None


def are_same(one: Any, other: Any) -> bool:
    """Whether two values are the same; what is no number is the same as itself."""
    if type(one) is not type(other):
        return False
    if isinstance(one, tuple):
        return len(one) == len(other) and all(map(are_same, one, other))
    if one == other:
        return True
    if type(one).__module__ != "pxr.Vt":
        is_number = isinstance(one, float) or type(one).__module__ == "pxr.Gf"
        return is_number and str(one) == str(other)
    import numpy as np  # takes long, and hardly any stage says an array twice

    numbers, others = np.asarray(one), np.asarray(other)
    return numbers.dtype.kind == "f" and np.array_equal(numbers, others, equal_nan=True)
