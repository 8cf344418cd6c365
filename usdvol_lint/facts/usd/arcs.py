"""Where several specs may make up a prim: at composition arcs, and where sublayers overlap."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

from pxr import Pcp, Sdf

from usdvol_lint.facts.usd.calls import WITH_INSTANCES, get_prim_stack
from usdvol_lint.facts.usd.drawn import Drawn
from usdvol_lint.facts.usd.instances import in_prototype

_DIRECT = Pcp.DependencyTypeDirect | Pcp.DependencyTypeNonVirtual


class Layered(NamedTuple):
    """A drawn prim that several specs make up, strongest first; `parents` have children."""

    prim: Any
    specs: list[Any]
    parents: list[Any]


def prims_with_arcs(stage: Any) -> list[Any]:
    """The prims on which an arc is authored in any layer, in no certain order.

    USD's cache of compositions knows them: to ask every prim would take as long as the walk.
    """
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
    return list(filter(None, map(stage.GetPrimAtPath, paths)))


def layered_prims(stage: Any, drawn: Drawn) -> Iterator[Layered]:
    """The drawn prims that several specs make up; those in instances as the walk meets them."""
    local = [layer.pseudoRoot for layer in stage.GetLayerStack()]
    pending = _children_of_several(stage.GetPseudoRoot(), local)
    pending += (*prims_with_arcs(stage), *drawn.roots)
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
