"""Whether a spec that USD passes over says what counts anyway."""

from __future__ import annotations

from typing import Any

from pxr import Ar, Sdf

from usdvol_lint.facts.usd.opinions import strongest_opinion
from usdvol_lint.facts.usd.values import values_of

_UNKNOWN = object()


def says_the_same(spec: Any, attribute: Any) -> bool:
    """Whether an attribute spec says nothing, or nothing but what an attribute holds anyway.

    Files are compared by what they resolve to, and samples in their order, since the layer of the
    spec may have other times; an expression counts as the same, because only USD can evaluate it.
    """
    if not spec.HasInfo("default") and not spec.HasInfo("timeSamples"):
        return True
    said, held = _said(spec), _held(attribute)
    return len(said) == len(held) and all(map(_may_be_equal, said, held))


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
