"""What layers say on top of one that is a sublayer of theirs, and by itself has no such problem."""

from __future__ import annotations

from collections.abc import Container, Iterator
from itertools import pairwise
from typing import TYPE_CHECKING, Any, TypeAlias

from pxr import Sdf

from usdvol_lint.engine.alone import Alone
from usdvol_lint.engine.restating import keys_of
from usdvol_lint.engine.stagewide import says_of_all
from usdvol_lint.engine.waking import waking
from usdvol_lint.facts.usd.bringing import root_layer, way_to
from usdvol_lint.facts.usd.calls import get_parent, get_prim, get_prim_stack, is_pseudo_root
from usdvol_lint.facts.usd.indices import index_of
from usdvol_lint.facts.usd.nodes import nodes_of

if TYPE_CHECKING:
    from usdvol_lint.rule import Problem, Rule

_CHANGING = ("field:", "xformOp:", "material:")
"""Properties by which a prim of any type changes, though its type does not have them."""

_Edits: TypeAlias = "list[tuple[Any, Any | None]]"
"""Layers on top of one, each with what it says."""


class OnTop:
    """Finds the edits of layers on top, in the layer stack of the stage or that an arc brings."""

    def __init__(self, alone: Alone) -> None:
        self._alone = alone
        self._known: dict[tuple[Any, Any, bool], tuple[_Edits, Any | None]] = {}

    def recomposed(self) -> None:
        """Says that the stage was composed in another way."""
        self._known.clear()

    def edit(
        self, rule: Rule, problem: Problem, spec: Any, place: Any, node: Any = None
    ) -> Any | None:
        """What layers on top of that of a spec say, where this by itself has no such problem.

        `node` is that of the spec, and `place` the path there of the problem's prim; without one
        these are the stage's own.
        """
        layer, prim = spec.layer, get_prim(problem.at)
        node = node or index_of(prim).rootNode
        top = root_layer(node)
        if layer == top or place == Sdf.Path.absoluteRootPath:
            return None
        edits, woken = self._edits(prim, spec, place, node)
        if woken and self._alone.sleeps(layer, place):
            return woken
        if not edits or not self._alone.is_clean(rule, layer, place, spec):
            return None
        for above, edit in edits:
            is_stage = node.IsRootNode() and above == top
            if is_stage or not self._alone.is_clean(rule, above, place, spec):
                return edit or _edit_beside(problem, layer, above, top) or above.pseudoRoot
        return None

    def _edits(self, prim: Any, spec: Any, place: Any, node: Any) -> tuple[_Edits, Any | None]:
        """What layers on top say of a prim, or above it, and the spec that makes it active."""
        # Who decides with variables what a path to a file says is known already.
        is_path = isinstance(spec, Sdf.AttributeSpec) and spec.typeName == Sdf.ValueTypeNames.Asset
        key = place, spec.layer, is_path
        if key not in self._known:
            edits = _edits_on_top(prim, spec.layer, node, place, prims_only=is_path)
            self._known[key] = list(edits), waking(prim)
        return self._known[key]


def _edit_beside(problem: Problem, layer: Any, above: Any, top: Any) -> Any | None:
    """What comes in with a layer above, of a prim that the problem's is held against."""
    for other in problem.against:
        at = other[0] if isinstance(other, tuple) else getattr(other, "attribute", other)
        prim = get_prim(at)
        for node in nodes_of(index_of(prim)):
            if root_layer(node) == top:
                for each, edit in _edits_on_top(prim, layer, node, node.path):
                    if edit and each == above:
                        return edit
    return None


def _edits_on_top(
    prim: Any, layer: Any, node: Any, place: Any, prims_only: bool = True
) -> Iterator[tuple[Any, Any | None]]:
    """What layers of a node say of a prim, or of those above it, on top of one of its sublayers.

    Each layer that has the sublayer, the next one first, with the edit that comes in there: its own
    or one of a sublayer on top of that; None where what they say is of other prims, or of all.
    """
    order = list(node.layerStack.layers)
    way = [tree.layer for tree in way_to(node, layer)]
    for below, above in pairwise(reversed(way)):
        new = order[order.index(above) : order.index(below)]
        # Of a sublayer USD reads no variables.
        is_of_all = any(map(says_of_all, new)) or below.HasExpressionVariables()
        if any(each.rootPrims for each in new) or (is_of_all and not prims_only):
            levels = place.pathElementCount - 1
            edits = (edit_by(prim, (each,), levels, all_counts=True) for each in reversed(new))
            yield above, next(filter(None, edits), None)


def edit_by(prim: Any, layers: Container[Any], levels: int, all_counts: bool = False) -> Any | None:
    """What some layers say of the properties of a prim, or of the next one up so many levels.

    Those count that its type has, or that bind something or move it: a note is none.  Or else
    `all_counts`, metadata too.
    """
    for _ in range(levels + 1):
        own = [spec for spec in get_prim_stack(prim) if spec.layer in layers]
        known = frozenset(prim.GetPrimDefinition().GetPropertyNames())
        properties = [each for spec in own for each in spec.properties if _matters(each, known)]
        if len(properties) == 1:
            return properties[0]
        saying = [spec for spec in own if says(spec)] if all_counts else own[: len(properties)]
        if saying:
            return saying[0]
        if is_pseudo_root(prim := get_parent(prim)):
            break
    return None


def _matters(spec: Any, known: Container[str]) -> bool:
    """Whether a property's spec may change what a prim of these properties shows."""
    return spec.name in known or spec.name.startswith(_CHANGING)


def says(spec: Any) -> bool:
    """Whether a spec of a prim says more than that there is one."""
    return bool(spec.properties or keys_of(spec))
