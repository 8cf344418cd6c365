"""Which of several opinions on a stage is the strongest, and which arc brings them together."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any, NamedTuple, TypeAlias

from pxr import Pcp

from usdvol_lint.facts.usd.nodes import nodes_of

_ARCS = {
    Pcp.ArcTypeInherit: "inheritPaths",
    Pcp.ArcTypeVariant: "variantSetNames",
    Pcp.ArcTypeRelocate: "relocates",
    Pcp.ArcTypeReference: "references",
    Pcp.ArcTypePayload: "payload",
    Pcp.ArcTypeSpecialize: "specializes",
}
"""The kinds of arcs, the strongest first, and the field of a spec that holds them."""
_RANKS = {kind: rank for rank, kind in enumerate(_ARCS)}
_LOCAL = -1

_Step: TypeAlias = tuple[int, int, int, int]


class _Crossing(NamedTuple):
    """An arc into another layer stack: from a path in one to the other's root layer."""

    kind: Any
    source: Any
    path: Any
    target: str


class Opinion(NamedTuple):
    """A spec of a prim, or of a property of it."""

    prim: Any
    spec: Any


class _Standing(NamedTuple):
    """Where an opinion stands: `order` is less for a stronger one; the arcs from the root to it."""

    order: tuple[_Step, ...]
    crossings: tuple[_Crossing, ...]


def decisive(opinions: Sequence[Opinion]) -> Opinion:
    """The opinion that brings about what opinions contradict one another in.

    It is the strongest, unless its layers have none of the others: then it is the spec with the
    arc that first brought them together.
    """
    standings = [(each, found) for each in opinions if (found := _standing(each))]
    if len(standings) < 2:
        return standings[0][0] if standings else opinions[0]
    strongest, standing = min(standings, key=lambda pair: pair[1].order)
    shared = _shared([each.crossings for _, each in standings])
    if shared == len(standing.crossings):
        return strongest
    arc = _spec_with_arc(standing.crossings[shared])
    return Opinion(strongest.prim, arc) if arc else strongest


def path_beside(prim: Any, spec: Any) -> str:
    """The path of a prim in the namespace of a spec's layer, without variants; "" if it has none.

    The prim is the spec's own, or one that is composed from the same arcs.
    """
    layer = spec.layer
    nodes = (node for node in nodes_of(prim.GetPrimIndex()) if layer in node.layerStack.layers)
    node = next(nodes, None)
    return str(node.path.StripAllVariantSelections()) if node else ""


def is_composed_of(prim: Any, spec: Any) -> bool:
    """Whether a spec is one of those that make up a prim: those in value clips are not."""
    return _node(prim, spec) is not None


def _node(prim: Any, spec: Any) -> Any | None:
    path = (
        spec.path.GetPrimOrPrimVariantSelectionPath() if spec.path.pathElementCount else spec.path
    )
    for node in nodes_of(prim.GetPrimIndex()):
        if node.path == path and spec.layer in node.layerStack.layers:
            return node
    return None


def prim_path(spec: Any) -> Any:
    """The path of the prim of a spec, with the variants that it stands in."""
    path = spec.path
    return path.GetPrimOrPrimVariantSelectionPath() if path.pathElementCount else path


def _standing(opinion: Opinion) -> _Standing | None:
    prim = opinion.prim
    while not (node := _node(prim, opinion.spec)):
        if prim.IsPseudoRoot():
            return None
        prim = prim.GetParent()
    layers = node.layerStack.layers
    last = (_LOCAL, 0, 0, layers.index(opinion.spec.layer))
    chain = list(_from_root(node))
    steps = [
        (_RANKS.get(each.arcType, len(_RANKS)), -each.namespaceDepth, each.siblingNumAtOrigin, 0)
        for each in chain
    ]
    return _Standing((*steps, last), tuple(_crossings(chain)))


def _from_root(node: Any) -> Iterator[Any]:
    """The nodes from the root to this one, without the root."""
    if not node.IsRootNode():
        yield from _from_root(node.parent)
        yield node


def _crossings(chain: Iterable[Any]) -> Iterator[_Crossing]:
    for node in chain:
        target = _root_layer(node)
        if target != _root_layer(node.parent):
            yield _Crossing(node.arcType, node.parent.layerStack, node.GetIntroPath(), target)


def _root_layer(node: Any) -> str:
    return str(node.layerStack.identifier.rootLayer.identifier)


def _shared(every: Sequence[tuple[_Crossing, ...]]) -> int:
    """How many arcs all have in common, from the first on."""
    count = 0
    for crossings in zip(*every, strict=False):
        if len({(each.path, each.target) for each in crossings}) > 1:
            break
        count += 1
    return count


def _spec_with_arc(crossing: _Crossing) -> Any | None:
    """The strongest spec that holds an arc."""
    specs = (layer.GetPrimAtPath(crossing.path) for layer in crossing.source.layers)
    key = _ARCS.get(crossing.kind, "")
    return next((spec for spec in specs if spec and spec.HasInfo(key)), None)
