"""The sublayers of a layer, and the paths by which it names them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from pxr import Sdf, Usd

from usdvol_lint.engine.saying import has_value


def sublayer_with(at: Any, layer: Any) -> str | None:
    """The path by which a layer names the sublayer with the strongest value of a property there."""
    stack = at.GetPropertyStack() if isinstance(at, Usd.Property) else ()
    below = sublayers(layer)
    valued = [spec.layer for spec in stack if has_value(spec) and spec.layer in below]
    return sublayer_path(layer, valued[:1])


def sublayers(layer: Any) -> list[Any]:
    """The sublayers of a layer that are open, and those of these."""
    found = [layer]
    for each in found:
        others = (Sdf.Layer.FindRelativeToLayer(each, str(path)) for path in each.subLayerPaths)
        found += [other for other in others if other and other not in found]
    return found[1:]


def sublayer_path(layer: Any, wanted: Sequence[Any]) -> str | None:
    """The path by which a layer names one of some others as a sublayer."""
    paths = layer.subLayerPaths
    return next((str(p) for p in paths if Sdf.Layer.FindRelativeToLayer(layer, p) in wanted), None)
