"""Finds where layers from outside a repository come into the stage's own file."""

from __future__ import annotations

from typing import Any

from pxr import Sdf

from usdvol_lint.engine.strength import Opinion, node_with
from usdvol_lint.facts.usd.bringing import FIELDS_OF_ARCS, Crossing, crossings, root_layer
from usdvol_lint.layertext.source import LayerTexts
from usdvol_lint.paths import below


class Entries:
    """Lines of stages for what a code host has no file of; `repository` is a canonical folder."""

    def __init__(self, repository: str, texts: LayerTexts) -> None:
        self._repository = repository
        self._texts = texts

    def of(self, prim: Any, spec: Any, file: str) -> tuple[int, int] | None:
        """Line and column of the arc or sublayer through which a spec comes into the stage's file.

        None where the file of the spec's layer is in the repository, or where the arc stands in
        another layer, or in a crate.
        """
        root = prim.GetStage().GetRootLayer()
        text = None if below(file, self._repository) != file else self._texts.of(root)
        if text is None or spec.layer == root:
            return None
        node = node_with(Opinion(prim, spec))
        arcs = crossings(node) if node else []
        arc = arcs[0] if arcs else None
        holder = arc.spec if arc else spec
        if arc and holder and holder.layer == root:
            position = text.find(str(holder.path), asset=_asset_path(arc, holder))
        else:
            path = _sublayer_path(root, holder.layer) if holder else None
            position = text.find("/", asset=path) if path else None
        return (position.line, position.column) if position else None


def _asset_path(arc: Crossing, holder: Any) -> str | None:
    """The path by which an arc names its layer."""
    arcs = holder.GetInfo(FIELDS_OF_ARCS[arc.node.arcType])
    for each in arcs.GetAddedOrExplicitItems():
        path = getattr(each, "assetPath", "")
        if path and Sdf.Layer.FindRelativeToLayer(holder.layer, path) == root_layer(arc.node):
            return str(path)
    return None


def _sublayer_path(root: Any, layer: Any) -> str | None:
    """The path by which a layer names one of its sublayers."""
    for path in root.subLayerPaths:
        if Sdf.Layer.FindRelativeToLayer(root, path) == layer:
            return str(path)
    return None
