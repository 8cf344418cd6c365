"""Which layer decides what an asset path with expression variables says."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from pxr import Sdf

from usdvol_lint.facts.usd.bringing import from_root, naming_sublayer, node_of, root_layer


def deciding_layer(prim: Any, spec: Any, time: float | None) -> Any | None:
    """The layer with the variables of a spec's asset path, if they are not of its own layer stack.

    Where these are those of a sublayer, which USD does not read, it is the layer that names it.

    `time` is a time of the layer, None for the default.
    """
    if spec.typeName != Sdf.ValueTypeNames.Asset:
        return None
    value = spec.default if time is None else spec.layer.QueryTimeSample(spec.path, time)
    text = _text(value)
    if not Sdf.VariableExpression.IsExpression(text):
        return None
    used = Sdf.VariableExpression(text).Evaluate({}).usedVariables
    node = node_of(prim, spec)
    said = (top for top in _tops(prim, node) if used & _said_by(top))
    decides = next(said, None)
    if decides is None and node is not None:
        return naming_sublayer(node, spec.layer, lambda each: bool(used & _said_by(each)))
    return None if node is None or decides == root_layer(node) else decides


def _said_by(layer: Any) -> set[str]:
    return set(layer.expressionVariables)


def _tops(prim: Any, node: Any | None) -> Iterator[Any]:
    """The layers that may say variables for a node, the strongest first."""
    yield prim.GetStage().GetRootLayer()
    if node is not None:
        yield from map(root_layer, from_root(node))


def _text(value: Any) -> str:
    """An asset path as authored, before its variables were replaced."""
    if not isinstance(value, Sdf.AssetPath):
        return ""
    return str(getattr(value, "authoredPath", value.path))
