"""Which layer decides what an asset path with expression variables says."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from typing import Any

from pxr import Sdf

from usdvol_lint.facts.usd.bringing import from_root, naming_sublayer, node_of, root_layer, way_to


def deciding_layer(prim: Any, spec: Any, time: float | None) -> Any | None:
    """The layer with the variables of a spec's asset path, if they are not of its own layer stack.

    Where these are those of a sublayer, which USD does not read, it is the layer that names it.
    Who only says them again, or others that lead to nothing either, does not decide.

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
    tops = [top for top in _tops(prim, node) if used & _said_by(top)]
    if node is None:
        return next(iter(tops), None)
    if not tops:
        return naming_sublayer(node, spec.layer, lambda each: bool(used & _said_by(each)))
    below = [tree.layer for tree in way_to(node, spec.layer)][1:]
    alone: list[list[Any]] = [[each] for each in below if used & _said_by(each)]
    if below and [spec.layer] not in alone:
        alone.append([])  # a sublayer that says none may lead to a file without any
    stages = [*(tops[n:] for n in range(len(tops))), *alone]
    said = [_path(text, spec.layer, layers) for layers in stages]
    last = next((n for n in range(1, len(said)) if not _is_as_bad(said[n], said[0])), len(said)) - 1
    decides = next(iter(stages[last]), spec.layer)
    is_own = last == len(stages) - 1 and decides in (root_layer(node), *below)
    return None if is_own else decides


def _is_as_bad(path: str | None, other: str | None) -> bool:
    """Whether two paths are one, or lead to nothing both."""
    return path == other or (
        not (path and os.path.exists(path)) and not (other and os.path.exists(other))
    )


def _path(text: str, layer: Any, tops: Sequence[Any]) -> str | None:
    """The absolute path that an expression gives under the variables of some layers."""
    variables: dict[str, Any] = {}
    for top in reversed(tops):
        variables |= dict(top.expressionVariables)
    value = Sdf.VariableExpression(text).Evaluate(variables).value
    return str(layer.ComputeAbsolutePath(value)) if isinstance(value, str) and value else None


def _said_by(layer: Any) -> set[str]:
    return set(layer.expressionVariables)


def _tops(prim: Any, node: Any | None) -> Iterator[Any]:
    """The layers that may say variables for a node, the strongest first."""
    tops = [prim.GetStage().GetRootLayer()]
    if node is not None:
        tops += map(root_layer, from_root(node))
    yield from dict.fromkeys(tops)


def _text(value: Any) -> str:
    """An asset path as authored, before its variables were replaced."""
    if not isinstance(value, Sdf.AssetPath):
        return ""
    return str(getattr(value, "authoredPath", value.path))
