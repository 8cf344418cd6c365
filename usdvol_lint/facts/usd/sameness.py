"""Whether a spec that USD passes over says what counts anyway."""

from __future__ import annotations

from bisect import bisect_left
from typing import Any

from pxr import Ar, Gf, Sdf, Vt

from usdvol_lint.facts.usd.calls import holder_of
from usdvol_lint.facts.usd.opinions import strongest_opinion
from usdvol_lint.facts.usd.steps import StepSamples
from usdvol_lint.facts.usd.values import values_of

_UNKNOWN = object()
_CLOSE = 1e-6
_INTERPOLATED = (
    *(float, Gf.Vec3f, Gf.Vec3d, Gf.Matrix4d, Gf.Quatf),
    *(Vt.FloatArray, Vt.HalfArray, Vt.Vec3fArray, Vt.Vec3hArray, Vt.QuatfArray, Vt.QuathArray),
)


def says_the_same(spec: Any, attribute: Any) -> bool:
    """Whether an attribute spec says nothing, or nothing but what an attribute holds anyway.

    That is, at each time at which one of them has a sample.  Files are compared by what they
    resolve to; an expression counts as the same, because only USD can evaluate it.
    """
    if not spec.HasInfo("default") and not spec.HasInfo("timeSamples"):
        return True
    said, held = _said(spec, attribute), _held(attribute)
    if not said.times and not held.times:
        return _may_be_equal(said.default, held.default)
    return all(_may_be_equal(*_at(time, said, held, attribute)) for time in said.times) and all(
        _is_between(said, time) or _may_be_equal(*_at(time, said, held, attribute))
        for time in held.times
    )


def _at(time: float, said: Any, held: Any, attribute: Any) -> tuple[Any, Any]:
    """What is said and what is held at a time; only USD knows what it interpolates."""
    value = attribute.Get(time) if _is_between(held, time) else held.at(time + _CLOSE)
    return said.at(time + _CLOSE), value


def _is_between(samples: Any, time: float) -> bool:
    """Whether a value that is interpolated lies between two samples at a time."""
    times = samples.times
    if not times or not isinstance(samples.at(time), _INTERPOLATED):
        return False
    following = bisect_left(times, time - _CLOSE)
    return 0 < following < len(times) and times[following] > time + _CLOSE


def _offset(prim_spec: Any, prim: Any) -> Any:
    """The `Sdf.LayerOffset` from the time of a spec's layer, which counts on the prim or above."""
    while prim_spec and prim:
        for each, offset in prim.GetPrimStackWithLayerOffsets():
            if each == prim_spec:
                return offset
        prim_spec, prim = prim_spec.nameParent, prim.GetParent()
    return Sdf.LayerOffset()


def _said(spec: Any, attribute: Any) -> StepSamples[Any]:
    offset = _offset(holder_of(spec), attribute.GetPrim())
    samples = spec.GetInfo("timeSamples") if spec.HasInfo("timeSamples") else {}
    timed = [(offset * time, samples[time]) for time in sorted(samples)]
    return StepSamples(
        (time, _UNKNOWN if _is_expression(value) else _comparable(value, spec.layer))
        for time, value in timed or [(None, spec.default)]
    )


def _held(attribute: Any) -> StepSamples[Any]:
    held = values_of(attribute)
    opinion = strongest_opinion(attribute, held.samples[-1].time)
    layer = opinion.spec.layer if opinion else None
    return StepSamples((time, _comparable(value, layer)) for time, value in held.samples)


def _comparable(value: Any, layer: Any) -> Any:
    if isinstance(value, Sdf.ValueBlock):
        return None
    if not isinstance(value, Sdf.AssetPath):
        return value
    path = value.resolvedPath or (layer.ComputeAbsolutePath(value.path) if layer else value.path)
    return str(Ar.GetResolver().Resolve(path)) or path


def _is_expression(value: Any) -> bool:
    return isinstance(value, Sdf.AssetPath) and Sdf.VariableExpression.IsExpression(value.path)


def _may_be_equal(said: Any, held: Any) -> bool:
    return said is _UNKNOWN or bool(said == held)
