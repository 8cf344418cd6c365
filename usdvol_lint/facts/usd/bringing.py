"""The arcs that bring opinions from one layer stack into another, on the way to the stage."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import Any, NamedTuple

from pxr import Pcp

from usdvol_lint.facts.usd.indices import index_of
from usdvol_lint.facts.usd.nodes import nodes_of

FIELDS_OF_ARCS = {
    Pcp.ArcTypeInherit: "inheritPaths",
    Pcp.ArcTypeVariant: "variantSetNames",
    Pcp.ArcTypeRelocate: "relocates",
    Pcp.ArcTypeReference: "references",
    Pcp.ArcTypePayload: "payload",
    Pcp.ArcTypeSpecialize: "specializes",
}
"""The kinds of arcs, the strongest first, and the field of a spec that holds them."""


class Crossing(NamedTuple):
    """An arc into another layer stack: its node there, and the node that it was authored at."""

    node: Any
    source: Any

    @property
    def spec(self) -> Any | None:
        """The strongest spec that holds the arc."""
        path, key = self.node.GetIntroPath(), FIELDS_OF_ARCS.get(self.node.arcType, "")
        specs = (layer.GetPrimAtPath(path) for layer in self.source.layerStack.layers)
        return next((spec for spec in specs if spec and spec.HasInfo(key)), None)

    @property
    def key(self) -> tuple[str, str]:
        """What is the same of this arc for all prims that it brings."""
        return str(self.node.GetIntroPath()), root_layer(self.node).identifier


def node_of(prim: Any, spec: Any) -> Any | None:
    """The node of a prim that a spec, of it or a property, is in; None for one in value clips."""
    path = path_of_prim(spec)
    for node in nodes_of(index_of(prim)):
        if node.path == path and spec.layer in node.layerStack.layers:
            return node
    return None


def node_above(prim: Any, spec: Any) -> Any | None:
    """The node of a prim that a spec is in, or lies below."""
    for node in nodes_of(index_of(prim)):
        if spec.path.HasPrefix(node.path) and spec.layer in node.layerStack.layers:
            return node
    return None


def path_of_prim(spec: Any) -> Any:
    """The path of the prim of a spec, with the variants that it stands in."""
    path = spec.path
    return path.GetPrimOrPrimVariantSelectionPath() if path.pathElementCount else path


def from_root(node: Any) -> list[Any]:
    """The nodes from the root to this one, without the root."""
    found = []
    while not node.IsRootNode():
        found.append(node)
        node = node.parent
    return found[::-1]


def as_introduced(node: Any) -> Any:
    """The node where its arc is authored: USD also puts what is specialized below the root."""
    origin = node.origin
    while origin and origin.path == node.path and root_layer(origin) == root_layer(node):
        node, origin = origin, origin.origin
    return node


def crossings(node: Any) -> list[Crossing]:
    """The arcs into other layer stacks that lead from the root to a node, in this order."""
    found = []
    node = as_introduced(node)
    while not node.IsRootNode():
        parent = node.parent
        if root_layer(node) != root_layer(parent):
            found.append(Crossing(node, parent))
        node = as_introduced(parent)
    return found[::-1]


def root_layer(node: Any) -> Any:
    """The root layer of the layer stack that a node is in."""
    return node.layerStack.identifier.rootLayer


def naming_sublayer(node: Any, layer: Any, says: Callable[[Any], bool]) -> Any | None:
    """The layer of a node that names a sublayer which says something of stages, and does not.

    Only what a stage's root layer says of it counts, so that it loses what the sublayer says; this
    is `layer`, or has it as sublayer.
    """
    way = [tree.layer for tree in way_to(node, layer)]
    if not way or says(way[0]):
        return None
    return next((above for above, below in pairwise(way) if says(below)), None)


def way_to(node: Any, layer: Any) -> tuple[Any, ...]:
    """The `Sdf.LayerTree`s from the top of a node's layers to a layer; none if it is not there."""
    waiting: list[tuple[Any, ...]] = [(node.layerStack.layerTree,)]
    while waiting:
        way = waiting.pop()
        if way[-1].layer == layer:
            return way
        waiting += ((*way, below) for below in reversed(way[-1].childTrees))
    return ()


def losing_spec(prim: Any, spec: Any, says: Callable[[Any], bool]) -> Any | None:
    """The spec by which what a layer says of stages is lost: the next layer does not say it."""
    node = node_of(prim, spec)
    if node is None:
        return None
    if namer := naming_sublayer(node, spec.layer, says):
        return namer.pseudoRoot
    lost = (
        each.spec
        for each in reversed(crossings(node))
        if says(root_layer(each.node)) and not says(root_layer(each.source))
    )
    return next(lost, None)


def meeting_spec(prim: Any, layer: Any, differs: Callable[[Any], bool]) -> Any:
    """The spec by which a prim's layer first comes into one that differs, on the way to the stage.

    That is the spec of an arc in that layer, or its top where what comes is in a sublayer of it;
    where none does, the top of the stage.
    """
    nodes = (each for each in nodes_of(index_of(prim)) if layer in each.layerStack.layers)
    node = next(nodes, None)
    arcs = crossings(node)[::-1] if node else []
    for arc in (None, *arcs):
        if arc and arc.spec and differs(arc.spec.layer):
            return arc.spec
        inside = arc.spec and arc.spec.layer if arc else layer
        for tree in way_to(arc.source if arc else node, inside)[-2::-1]:
            if differs(tree.layer):
                return tree.layer.pseudoRoot
    return prim.GetStage().GetRootLayer().pseudoRoot


def arc_losing(prim: Any, spec: Any, path: Any) -> Any | None:
    """The spec with the first arc, on the way to the stage, that does not bring a path of a spec.

    The path has another name beyond each arc, so all of them are gone through.
    """
    path = path.MakeAbsolutePath(path_of_prim(spec).StripAllVariantSelections())
    node = node_of(prim, spec)
    while node and not node.IsRootNode():
        node = as_introduced(node)
        path = node.mapToParent.MapSourceToTarget(path)
        if path.isEmpty:
            return Crossing(node, node.parent).spec
        node = node.parent
    return None
