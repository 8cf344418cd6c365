"""Whether a spec that USD passes over says what counts anyway."""

from __future__ import annotations

from functools import partial
from math import isclose
from typing import Any

from pxr import Ar, Sdf

from usdvol_lint.facts.usd.opinions import strongest_opinion
from usdvol_lint.facts.usd.values import values_of

_UNKNOWN = object()
_CLOSE = 1e-6


def says_the_same(spec: Any, attribute: Any) -> bool:
    """Whether an attribute spec says nothing, or nothing but what an attribute holds anyway.

    Files are compared by what they resolve to, and samples in their order and by their times on the
    stage; an expression counts as the same, because only USD can evaluate it.
    """
    if not spec.HasInfo("default") and not spec.HasInfo("timeSamples"):
        return True
    said, held = _said(spec), _held(attribute)
    if len(said) != len(held) or not all(map(_may_be_equal, said, held)):
        return False
    return all(_may_be_equal(value, said[0]) for value in said) or _has_the_times(spec, attribute)


def _has_the_times(spec: Any, attribute: Any) -> bool:
    """Whether the samples of a spec are at the times of an attribute, where its layer has them."""
    offset = _offset(spec.owner, attribute.GetPrim())
    said = [offset * time for time in sorted(spec.GetInfo("timeSamples"))]
    return all(map(partial(isclose, abs_tol=_CLOSE), said, values_of(attribute).times))


def _offset(prim_spec: Any, prim: Any) -> Any:
    """The `Sdf.LayerOffset` from the time of a spec's layer, which counts on the prim or above."""
    while prim_spec and prim:
        for each, offset in prim.GetPrimStackWithLayerOffsets():
            if each == prim_spec:
                return offset
        prim_spec, prim = prim_spec.nameParent, prim.GetParent()
    return Sdf.LayerOffset()


def _said(spec: Any) -> list[Any]:
    samples = spec.GetInfo("timeSamples") if spec.HasInfo("timeSamples") else {}
    values = [samples[time] for time in sorted(samples)] or [spec.default]
    return [
        _UNKNOWN if _is_expression(value) else _comparable(value, spec.layer) for value in values
    ]


def _held(attribute: Any) -> list[Any]:
    held = values_of(attribute)
    opinion = strongest_opinion(attribute, held.samples[-1].time)
    layer = opinion.spec.layer if opinion else None
    values = [value for time, value in held.samples if time is not None or not held.total]
    return [_comparable(value, layer) for value in values]


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
