"""What is clean in its layer and wrong on the stage: an arc to a piece, or an edit, is why."""

from __future__ import annotations

from collections.abc import Container, Sequence
from itertools import islice
from typing import TYPE_CHECKING, Any, NamedTuple

from pxr import Sdf

from usdvol_lint.engine.alone import Alone
from usdvol_lint.engine.already import Already
from usdvol_lint.engine.on_top import OnTop, edit_by
from usdvol_lint.engine.stagewide import says_of_all, stage_edit
from usdvol_lint.engine.sublayers import sublayers
from usdvol_lint.engine.waking import waking
from usdvol_lint.facts.usd.bringing import Crossing, crossings, path_of_prim, root_layer, way_to
from usdvol_lint.facts.usd.calls import (
    get_parent,
    get_prim,
    get_prim_stack,
    get_stage,
    holder_of,
    is_pseudo_root,
    prim_at,
)
from usdvol_lint.facts.usd.indices import index_of
from usdvol_lint.facts.usd.nodes import nodes_of
from usdvol_lint.rule import STAGE

if TYPE_CHECKING:
    from usdvol_lint.rule import Problem, Rule


_CHANGING = ("apiSchemas", "variantSelection", "clips", "active")
"""Metadata by which a prim changes; who makes instances is told elsewhere."""


class _Brought(NamedTuple):
    """How an arc brings a layer.

    `is_whole` is whether a prim at its top stands above what it brings, on the stage too, and
    `is_edited` whether other layers say something of it, of what is below, or of whole stages.
    `woken` is the spec that makes active what another one deactivates.
    """

    is_whole: bool
    is_edited: bool
    woken: Any | None = None


class Pieces:
    """Finds what makes something wrong of a layer that is clean by itself.

    That is an arc which brings a piece of it, a prim without those above: what stands there, such
    as a bound material or a transform, may be what a rule asks for.  Or it is what the stage's own
    layers say of the same prim, where the rule does not tell that it looks at that.
    """

    def __init__(self, alone: Alone) -> None:
        self._alone = alone
        self.already = Already(alone)
        self._on_top = OnTop(alone)
        self._known: dict[tuple[str, str, Any], _Brought] = {}
        self._known_at: dict[tuple[str, str, Any], _Brought] = {}
        self._own: frozenset[Any] | None = None
        self._switched: bool | None = None
        self._saying: list[Any] | None = None

    def recomposed(self) -> None:
        """Says that the stage was composed in another way."""
        self._switched = self._saying = None
        self._known.clear()
        self._known_at.clear()
        self._on_top.recomposed()

    def are_switched(self, prim: Any) -> bool:
        """Whether the tool composed another variant, which no layer has when it is opened alone.

        A variant is a part of its asset, whichever layer selects it.
        """
        if self._switched is None:
            session = get_stage(prim).GetSessionLayer()
            self._switched = bool(session and session.rootPrims)
        return self._switched

    def instead(self, rule: Rule, problem: Problem, spec: Any, path: str) -> Any | None:
        """The spec to blame for a problem at a path of the stage, in place of `spec`.

        None if that is to blame itself: nearly always, since its layer is brought as a whole, or
        opened alone has the problem too.
        """
        if not rule.on:
            return None  # what the engine tells, no prim is handed to
        layer = spec.layer
        if spec.path == Sdf.Path.absoluteRootPath:
            return self._with_variables(rule, problem, layer)
        if layer in (self._own or self._local(problem)):
            return self._on_top.edit(rule, problem, spec, Sdf.Path(path))
        is_whole, is_edited, woken = self._at(problem, spec, layer, path)
        if not (is_edited or woken) and is_whole and not (problem.absent and STAGE in rule.on):
            return None
        prim = get_prim(problem.at)
        arcs = _arcs_to(prim, spec)
        if woken and arcs and self._alone.sleeps(*_end_of(arcs[-1])):
            return woken
        if edit := self._edit_inside(rule, problem, spec, arcs):
            return edit
        if not is_whole and not any(map(_is_to_piece, arcs)):
            return None
        found = None
        for arc in reversed(arcs):
            if not self._alone.is_clean(rule, *_end_of(arc), spec):
                break
            found = arc
        if not found or not is_whole:
            return found and found.spec  # what stands beside a piece is lacking, whatever is edited
        layers, levels = self._first_wrong(rule, spec, found), _levels_below(found)
        edit = edit_by(prim, layers, levels) or stage_edit(found, layers)
        return edit or edit_by(prim, layers, levels, all_counts=True) or found.spec

    def _with_variables(self, rule: Rule, problem: Problem, layer: Any) -> Any | None:
        """The top of the layer whose variables lead a sublayer of another one elsewhere."""
        stage, place = get_stage(problem.at), Sdf.Path.absoluteRootPath
        if layer == stage.GetRootLayer():
            return None
        if self._saying is None:
            self._saying = _with_variables(stage)
        others = [each for each in self._saying if each != layer]
        if not others or self._alone.alike(rule, layer, place, problem):
            return None  # nearly always
        found = (each for each in others if self._alone.alike(rule, each, place, problem))
        return next((each.pseudoRoot for each in found), None)

    def _edit_inside(
        self, rule: Rule, problem: Problem, spec: Any, arcs: Sequence[Crossing]
    ) -> Any | None:
        """What is said on top of a sublayer in the layer stack that the last arc brings."""
        if not arcs:
            return None
        _, place = _end_of(arcs[-1])
        return self._on_top.edit(rule, problem, spec, place, arcs[-1].node)

    def _first_wrong(self, rule: Rule, spec: Any, arc: Crossing) -> Sequence[Any]:
        """The layers with which what an arc brings becomes wrong: a sublayer of those, or all.

        The ones above that have it as a sublayer, whatever they add.
        """
        node = arc.source  # of a class that has the arc, its heir is what the layers show
        while not node.IsRootNode() and root_layer(node.parent) == root_layer(node):
            node = node.parent
        place = node.path.StripAllVariantSelections()
        for tree in way_to(arc.source, arc.spec.layer)[:0:-1] if arc.spec else ():
            if not self._alone.is_clean(rule, tree.layer, place, spec):
                return [tree.layer, *sublayers(tree.layer)]
        layers: Sequence[Any] = arc.source.layerStack.layers
        return layers

    def _at(self, problem: Problem, spec: Any, layer: Any, path: str) -> _Brought:
        """How the layer of a spec comes to a path: the same for all properties of its prim."""
        own = str(spec.path)
        key = own if "{" in own else own.partition(".")[0], path, layer
        if key not in self._known_at:
            found = self._brought(problem, spec, path)
            self._known_at[key] = found._replace(woken=waking(get_prim(problem.at)))
        return self._known_at[key]

    def _local(self, problem: Problem) -> frozenset[Any]:
        """The root layer and its sublayers, which no arc brings."""
        if self._own is None:
            stage = get_stage(problem.at)
            self._own = frozenset(stage.GetLayerStack())
        return self._own

    def _brought(self, problem: Problem, spec: Any, path: str) -> _Brought:
        """How a layer comes to where a problem is: the same for all that one arc brings."""
        if path == "/" or spec.path == spec.path.absoluteRootPath:
            return _Brought(is_whole=True, is_edited=False)
        own = str(spec.path.GetPrimPath().StripAllVariantSelections()).split("/")
        names = path.split("/")
        names = names[: len(names) - _levels_up(get_prim(problem.at), spec)]
        top = len(names) - len(own) + 1
        if top < 1 or names[top + 1 :] != own[2:]:
            return _Brought(is_whole=False, is_edited=False)
        above = "/".join(names[: top + 1])
        key = above, own[1], spec.layer
        if key not in self._known:
            prim = prim_at(get_stage(problem.at), above)
            stack = get_prim_stack(prim) if prim else ()
            self._known[key] = _Brought(
                not _has_others(spec.layer) and spec.layer.GetPrimAtPath(f"/{own[1]}") in stack,
                _is_edited(prim, spec.layer),
            )
        return self._known[key]


def _with_variables(stage: Any) -> list[Any]:
    """The layers of a stage with expression variables: those that arcs bring, then the weakest."""
    own = [each for each in stage.GetLayerStack() if each.HasExpressionVariables()]
    saying = {each for each in stage.GetUsedLayers() if each.HasExpressionVariables()}
    brought = sorted(saying.difference(own), key=lambda each: str(each.identifier))
    return [*brought, *reversed(own)]


def _levels_up(prim: Any, spec: Any) -> int:
    """How many prims up that is which has a spec; 0 too if it is none above."""
    levels, own = 0, holder_of(spec)
    while not is_pseudo_root(prim):
        if own in get_prim_stack(prim):
            return levels
        prim, levels = get_parent(prim), levels + 1
    return 0


def _is_edited(prim: Any | None, layer: Any) -> bool:
    """Whether other layers than one say something of a prim, of what is below, or of the stage."""
    if prim is None:
        return False
    layers = {each for node in nodes_of(index_of(prim)) for each in node.layerStack.layers}
    stack = get_prim_stack(prim)
    types = {each.typeName for each in stack if each.layer == layer}
    others = [each for each in stack if each.layer != layer]
    return any(_changes(each, types) for each in others) or any(map(says_of_all, layers))


def _changes(spec: Any, types: Container[str]) -> bool:
    """Whether a spec of a prim says more than an arc and one of these types."""
    if spec.properties or spec.nameChildren or (spec.typeName and spec.typeName not in types):
        return True
    return any(map(spec.HasInfo, _CHANGING))


def _arcs_to(prim: Any, spec: Any) -> list[Crossing]:
    """The arcs from the root to a spec of a prim, or of one above it."""
    path = path_of_prim(spec)
    for node in nodes_of(index_of(prim)):
        if node.path.HasPrefix(path) and spec.layer in node.layerStack.layers:
            return crossings(node)
    return []


def _end_of(arc: Crossing) -> tuple[Any, Any]:
    """The root layer of what an arc brings, and the path there of what is shown."""
    return root_layer(arc.node), arc.node.path.StripAllVariantSelections()


def _is_to_piece(arc: Crossing) -> bool:
    """Whether an arc leads to a prim that has others above or beside it."""
    target = arc.node.GetPathAtIntroduction().StripAllVariantSelections()
    return bool(target.pathElementCount > 1 or _has_others(root_layer(arc.node)))


def _has_others(layer: Any) -> bool:
    """Whether several prims are defined at the top of a layer; of a class its heirs have all."""
    defined = (prim for prim in layer.rootPrims if prim.specifier == Sdf.SpecifierDef)
    return any(islice(defined, 1, None))


def _levels_below(arc: Crossing) -> int:
    """How many prims what an arc brings lies below its top."""
    paths = (arc.node.path, arc.node.GetPathAtIntroduction())
    below, top = (path.StripAllVariantSelections().pathElementCount for path in paths)
    return int(below - top)
