"""What a layer says of all that comes below: its relocates, and its expression variables."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from usdvol_lint.facts.usd.bringing import Crossing, root_layer


def says_of_all(layer: Any) -> bool:
    """Whether a layer moves or takes away prims that arcs bring, or has expression variables."""
    return bool(layer.HasRelocates() or layer.HasExpressionVariables())


def stage_edit(arc: Crossing, layers: Sequence[Any]) -> Any | None:
    """The top of the one of some layers that changes what an arc brings, without a spec of a prim.

    It relocates a prim at or below the one with the arc, or has another value of a variable that
    the layer brought has too.
    """
    place = arc.node.GetIntroPath().StripAllVariantSelections()
    for layer in layers:
        if any(source.HasPrefix(place) for source, _ in layer.relocates):
            return layer.pseudoRoot
    own = root_layer(arc.source)
    said, others = own.expressionVariables, root_layer(arc.node).expressionVariables
    return own.pseudoRoot if any(said[key] != others.get(key) for key in said) else None
