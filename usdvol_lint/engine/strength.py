"""Which of several opinions on a stage is the strongest, and which arc brings them together."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple, TypeAlias

from pxr import Sdf

from usdvol_lint.facts.usd.bringing import (
    FIELDS_OF_ARCS,
    Crossing,
    crossings,
    from_root,
    node_above,
    node_of,
    path_of_prim,
)
from usdvol_lint.facts.usd.indices import index_of
from usdvol_lint.facts.usd.nodes import nodes_of

_RANKS = {kind: rank for rank, kind in enumerate(FIELDS_OF_ARCS)}
_LOCAL = -1

_Step: TypeAlias = tuple[int, int, int, int]


class Opinion(NamedTuple):
    """A spec of a prim, or of a property of it."""

    prim: Any
    spec: Any


class Standing(NamedTuple):
    """Where an opinion stands: `order` is less for a stronger one; the arcs from the root to it.

    `keys` are the same for the arcs of an instance and for those of the prims below it.
    """

    order: tuple[_Step, ...]
    crossings: tuple[Crossing, ...]
    keys: tuple[tuple[str, str], ...]


def decisive(opinions: Sequence[Opinion]) -> Opinion:
    """The opinion that brings about what opinions contradict one another in.

    It is the strongest, unless its layers have none of the others: then it is the spec with the
    arc that first brought them together.
    """
    standings = [(each, found) for each in opinions if (found := standing_of(each))]
    if len(standings) < 2:
        return standings[0][0] if standings else opinions[0]
    strongest, standing = min(standings, key=lambda pair: pair[1].order)
    shared = _shared([each.keys for _, each in standings])
    if shared == len(standing.crossings):
        return strongest
    arc = standing.crossings[shared].spec
    return Opinion(strongest.prim, arc) if arc else strongest


def path_beside(prim: Any, spec: Any) -> str:
    """The path of a prim in the namespace of a spec's layer, without variants; "" if it has none.

    The prim is the spec's own, or one that is composed from the same arcs: of several paths that it
    has in that layer, such as its own and that of a class, the one nearest to the spec's counts.
    """
    layer, path = spec.layer, path_of_prim(spec)
    nodes = [node for node in nodes_of(index_of(prim)) if layer in node.layerStack.layers]

    def shared(node: Any) -> int:
        return int(node.path.GetCommonPrefix(path).pathElementCount)

    return str(max(nodes, key=shared).path.StripAllVariantSelections()) if nodes else ""


def standing_of(opinion: Opinion) -> Standing | None:
    """Where an opinion stands; None where no layer of the stage has it."""
    node = node_with(opinion)
    if node is None:
        return None
    last = (_LOCAL, 0, 0, node.layerStack.layers.index(opinion.spec.layer))
    steps = [
        (_RANKS.get(each.arcType, len(_RANKS)), -each.namespaceDepth, each.siblingNumAtOrigin, 0)
        for each in from_root(node)
    ]
    arcs = tuple(crossings(node))
    return Standing((*steps, last), arcs, tuple(_keys(opinion.prim, arcs)))


def _keys(prim: Any, arcs: Sequence[Crossing]) -> Iterator[tuple[str, str]]:
    """What tells arcs apart: those of an instance as that has them which its prototype is made of.

    An instance is composed by itself, and what is below it once for all of them.
    """
    own = shared = prim.GetPath()
    below = prim.GetPrototype().GetAllChildren() if prim.IsInstance() else ()
    if below:
        own = index_of(prim).rootNode.path
        shared = index_of(below[0]).rootNode.path.GetParentPath()
    for arc in arcs:
        path, target = arc.key
        yield str(_moved(Sdf.Path(path), own, shared)), target


def _moved(path: Any, old: Any, new: Any) -> Any:
    """A path at, below or above `old`, as it is beside `new`."""
    for _ in range(old.pathElementCount - path.pathElementCount):
        old, new = old.GetParentPath(), new.GetParentPath()
    return path.ReplacePrefix(old, new)


def node_with(opinion: Opinion) -> Any | None:
    """The node of the spec, or the one above it that it would be below if USD composed it."""
    prim, spec = opinion
    node = node_of(prim, spec)
    while node is None and not prim.IsPseudoRoot():
        prim = prim.GetParent()
        node = node_above(prim, spec)
    return node


def _shared(every: Sequence[tuple[tuple[str, str], ...]]) -> int:
    """How many arcs all have in common, from the first on."""
    count = 0
    for keys in zip(*every, strict=False):
        if len(set(keys)) > 1:
            break
        count += 1
    return count
