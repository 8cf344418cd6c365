"""Where several specs may make up a prim: at composition arcs, and where sublayers overlap."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any, NamedTuple

from pxr import Pcp, Sdf

from usdvol_lint.cached import cached_property
from usdvol_lint.facts.usd.calls import WITH_INSTANCES, get_prim_stack
from usdvol_lint.facts.usd.drawn import Drawn
from usdvol_lint.facts.usd.instances import in_prototype

_DIRECT = Pcp.DependencyTypeDirect | Pcp.DependencyTypeNonVirtual


class Layered(NamedTuple):
    """A drawn prim that several specs make up, strongest first; `parents` have children."""

    prim: Any
    specs: list[Any]
    parents: list[Any]


class Arcs:
    """Where the opinions on a stage come from: its layers, and the arcs between prims."""

    def __init__(self, stage: Any, drawn: Drawn) -> None:
        self._stage = stage
        self._drawn = drawn

    @cached_property
    def is_one_layer(self) -> bool:
        """Whether nothing but the root layer says anything."""
        session = self._stage.GetSessionLayer()
        return {*self._stage.GetUsedLayers(), session} <= {self._stage.GetRootLayer(), session}

    @cached_property
    def prims(self) -> tuple[Any, ...]:
        """The prims on which an arc is authored in any layer, in no certain order."""
        return tuple(_prims_with_arcs(self._stage))

    @cached_property
    def layered(self) -> tuple[Layered, ...]:
        """The drawn prims that several specs make up; those in instances as the walk meets them."""
        if self.is_one_layer and not self.prims:
            return ()
        return tuple(_layered(self._stage, self.prims, self._drawn))


def _prims_with_arcs(stage: Any) -> Iterator[Any]:
    """USD's cache of compositions knows them: to ask every prim would take as long as the walk."""
    cache = stage._GetPcpCache()
    root = Sdf.Path.absoluteRootPath
    stacks = {
        stack
        for layer in stage.GetUsedLayers()
        for stack in cache.FindAllLayerStacksUsingLayer(layer)
    }
    paths = {
        dependency.indexPath
        for stack in stacks
        for dependency in cache.FindSiteDependencies(stack, root, _DIRECT, True, False, True)
    }
    return filter(None, map(stage.GetPrimAtPath, paths))


def _layered(stage: Any, with_arcs: Iterable[Any], drawn: Drawn) -> Iterator[Layered]:
    local = [layer.pseudoRoot for layer in stage.GetLayerStack()]
    pending = _children_of_several(stage.GetPseudoRoot(), local)
    pending += (*with_arcs, *drawn.roots)
    seen = set()
    while pending:
        prim = in_prototype(pending.pop())
        if prim in seen or prim not in drawn:
            continue
        seen.add(prim)
        specs = get_prim_stack(prim)
        if len(specs) > 1:
            parents = [spec for spec in specs if spec.HasInfo("primChildren")]
            yield Layered(prim, specs, parents)
            pending += _children_of_several(prim, parents)


def _children_of_several(prim: Any, parents: Sequence[Any]) -> list[Any]:
    """The drawn children of a prim of which several of its specs say something."""
    if len(parents) < 2:
        return []  # nearly always: the names of many children are read only where they matter
    seen: set[str] = set()
    shared: set[str] = set()
    for spec in parents:
        names = set(spec.nameChildren.keys())
        shared |= names & seen
        seen |= names
    return [
        child for child in prim.GetFilteredChildren(WITH_INSTANCES) if child.GetName() in shared
    ]
