"""Edits by which a layer takes away what weaker ones bring: arcs, a definition, another variant."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

from pxr import Sdf, Usd

from usdvol_lint.engine.strength import Opinion, node_with
from usdvol_lint.facts.usd.bringing import root_layer
from usdvol_lint.facts.usd.calls import (
    ARCS,
    get_path,
    get_prim_stack,
    get_stage,
    get_targets,
    parent_path,
    prim_at,
)
from usdvol_lint.facts.usd.diagnostics import UNREADABLE
from usdvol_lint.facts.usd.instances import on_stage, shown_path
from usdvol_lint.facts.usd.untyped import GROUP_TYPES
from usdvol_lint.rule import NotChecked, Problem
from usdvol_lint.schema import SPECIFIER, TYPE_NAME

_MAY_BE_LIVE = Usd.PrimIsActive & Usd.PrimIsLoaded & ~Usd.PrimIsAbstract

_Has = Callable[[Any, Any], bool]
"""Whether a stage has at a path what is missing."""


class Edit(NamedTuple):
    """A spec of a prim that takes away what the next weaker one says."""

    prim: Any
    spec: Any
    kept: Any


class Takings:
    """The edits of one stage that take something away; each layer is opened alone at most once."""

    def __init__(self) -> None:
        self._edits: dict[Any, tuple[Edit, ...]] = {}
        self._alone: dict[Any, Any | None] = {}

    def recomposed(self) -> None:
        """Says that the stage was composed in another way."""
        self._edits.clear()

    def edit(self, problem: Problem | NotChecked) -> Edit | None:
        """The edit without which nothing would be missing: then the layer below has it alone.

        Of several the strongest that is one; those above it merely did not mend it.
        """
        stage = get_stage(problem.at)
        for path, has in _missing(problem):
            edits = self._on_the_way(stage, path)
            if edits and not has(stage, path):
                for edit in edits:
                    if self._has_below(edit, path, has):
                        return edit
        return None

    def _on_the_way(self, stage: Any, path: Any) -> tuple[Edit, ...]:
        """The edits of the prims on the way to a path, the lowest first."""
        waiting = []
        while (found := self._edits.get(path)) is None and path.pathElementCount:
            waiting.append(path)
            path = parent_path(path)
        found = found or ()
        for each in reversed(waiting):
            prim = prim_at(stage, each)
            found = self._edits[each] = (*_edits(prim), *found) if prim else found
        return found

    def _has_below(self, edit: Edit, path: Any, has: _Has) -> bool:
        """Whether the weaker layer has by itself what is missing at a path of the stage."""
        top = root_layer_of(edit.prim, edit.kept)
        is_sublayer = top == root_layer_of(edit.prim, edit.spec)
        stage = self._opened(edit.kept.layer if is_sublayer else top)
        own = edit.kept.path.StripAllVariantSelections()
        return bool(stage) and has(stage, path.ReplacePrefix(edit.prim.GetPath(), own))

    def _opened(self, layer: Any) -> Any | None:
        if layer not in self._alone:
            try:
                self._alone[layer] = layer and Usd.Stage.Open(layer)
            except UNREADABLE:
                self._alone[layer] = None
        return self._alone[layer]


def root_layer_of(prim: Any, spec: Any) -> Any | None:
    """The root layer of the layer stack that a spec of a prim is in."""
    node = node_with(Opinion(prim, spec))
    return root_layer(node) if node else None


def _missing(problem: Problem | NotChecked) -> Iterator[tuple[Any, _Has]]:
    """The paths of what may be missing, each with how to tell."""
    at = problem.at
    if isinstance(at, Usd.Relationship):
        for target in get_targets(at):
            yield Sdf.Path(shown_path(get_stage(at), target.GetPrimPath())), _has_field
    for prim, name in (lack for part in problem.absent for lack in part):
        yield get_path(on_stage(prim)), _has(name)


def _has_field(stage: Any, path: Any) -> bool:
    """Whether a prim with a type of its own is live, once something defines those above it."""
    prim = stage.GetPrimAtPath(path)
    is_live = prim and prim.HasDefiningSpecifier() and _MAY_BE_LIVE(prim)
    return bool(is_live and prim.GetTypeName() not in GROUP_TYPES)


def _has(name: str) -> _Has:
    def has(stage: Any, path: Any) -> bool:
        prim = stage.GetPrimAtPath(path)
        if not prim or name == SPECIFIER:
            return bool(prim and prim.IsDefined())
        if name == TYPE_NAME:
            return prim.GetTypeName() not in GROUP_TYPES
        is_name = Sdf.Path.IsValidNamespacedIdentifier(name)
        attribute = prim.GetAttribute(name) if is_name else None
        return bool(attribute and attribute.HasAuthoredValue())

    return has


def _edits(prim: Any) -> Iterator[Edit]:
    stack = get_prim_stack(prim)
    if len(stack) < 2:
        return  # nearly always
    session = get_stage(prim).GetSessionLayer()
    own = [spec for spec in stack if spec.layer != session]
    for spec, kept in _pairs(prim, stack, own):
        yield Edit(prim, spec, kept)


def _pairs(prim: Any, stack: Sequence[Any], own: Sequence[Any]) -> Iterator[tuple[Any, Any]]:
    """The specs that take away, each with the next weaker one of which they do."""
    for key in ARCS:
        holders = [spec for spec in own if spec.HasInfo(key)]
        yield from (pair for pair in pairwise(holders) if _takes_arcs(prim, key, *pair))
    defining = [spec for spec in own if spec.specifier != Sdf.SpecifierOver]
    yield from (pair for pair in pairwise(defining) if _is_class(*pair))
    selecting = [spec for spec in stack if spec.HasInfo("variantSelection")]
    for name in sorted({name for spec in selecting for name in spec.GetInfo("variantSelection")}):
        holders = [spec for spec in selecting if name in spec.variantSelections]
        if holders[0] in own:
            yield from (pair for pair in pairwise(holders) if _differ(name, *pair))


def _takes_arcs(prim: Any, key: str, spec: Any, kept: Any) -> bool:
    """Whether a list of arcs lacks some on purpose that one at the same place brings."""
    listed = spec.GetInfo(key)
    takes = listed.isExplicit or listed.deletedItems
    if not takes or spec.path != kept.path or not kept.GetInfo(key).GetAddedOrExplicitItems():
        return False
    node = node_with(Opinion(prim, spec))  # another one may have the same path
    return node is not None and kept.layer in node.layerStack.layers


def _is_class(spec: Any, kept: Any) -> bool:
    return bool(spec.specifier == Sdf.SpecifierClass and kept.specifier == Sdf.SpecifierDef)


def _differ(name: str, spec: Any, kept: Any) -> bool:
    return bool(spec.variantSelections[name] != kept.variantSelections[name])
