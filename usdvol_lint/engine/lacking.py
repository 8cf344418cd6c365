"""What is absent, and where: the specs that lack it, and the place on the stage that shows it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, TypeAlias

from pxr import Sdf

from usdvol_lint.facts.usd.calls import get_prim_stack, get_stage
from usdvol_lint.facts.usd.indices import index_of
from usdvol_lint.facts.usd.instances import on_stage, shown
from usdvol_lint.facts.usd.nodes import nodes_of
from usdvol_lint.model import Lack
from usdvol_lint.rule import NotChecked, Problem

Absent: TypeAlias = tuple[frozenset[Lack], ...]


def absent_of(problem: Problem | NotChecked) -> Absent:
    """What is absent: of specs in files, and at the place of a prim that may have none itself.

    Another stage has to complete both: of two prims of one class it may complete only one.
    """
    if not problem.absent:
        return ()
    return tuple(
        frozenset(lack for prim, name in part for lack in lacks(prim, name))
        for part in problem.absent
        for lacks in (_of_specs, _of_place)
    )


def _of_specs(prim: Any, name: str) -> Iterator[Lack]:
    for spec in get_prim_stack(prim):
        if path := spec.layer.realPath:
            yield path, str(spec.path), name


def _of_place(prim: Any, name: str) -> Iterator[Lack]:
    if root := get_stage(prim).GetRootLayer().realPath:
        yield root, shown(prim).path, name


def absent_under(selection: str, absent: Absent, root: str) -> Absent:
    """What is absent under a selection of the stage whose root layer is the file `root`.

    Whoever completes it has to have selected the same.
    """
    prefixes = Sdf.Path(selection).GetPrefixes()
    steps = [each for each in prefixes if each.IsPrimVariantSelectionPath()]
    under = (
        frozenset(
            (root, str(_within(Sdf.Path(path), step)), name)
            for layer, path, name in part
            if layer == root
        )
        for part in absent
        for step in steps
    )
    return (*absent, *filter(None, under))


def _within(path: Any, step: Any) -> Any:
    """A path with one step of a selection, if it is below that."""
    set_name, variant = step.GetVariantSelection()
    above = step.StripAllVariantSelections()
    return path.StripAllVariantSelections().ReplacePrefix(
        above, above.AppendVariantSelection(set_name, variant)
    )


def places_of(prim: Any) -> Iterator[tuple[Any, str]]:
    """The paths that a prim has in the layers it comes from, and those with the variants there."""
    selected = list(_selections(prim))
    for node in nodes_of(index_of(prim)):
        path = node.path.StripAllVariantSelections()
        prefixes = path.GetPrefixes()
        paths = [path]
        for levels, set_name, variant in selected:
            if levels < len(prefixes):
                above = prefixes[-1 - levels]
                switch = above.AppendVariantSelection(set_name, variant)
                paths.append(path.ReplacePrefix(above, switch))
        for layer in node.layerStack.layers:
            yield from ((layer, str(each)) for each in paths)


def levels_to(spec: Any, above: Any) -> int:
    """How many prims a spec lies below another one of its layer."""
    paths = (each.path.StripAllVariantSelections() for each in (spec, above))
    below, top = (path.pathElementCount for path in paths)
    return int(below - top)


def prim_above(prim: Any, levels: int) -> Any:
    """The prim so many levels above another, where this one is shown first; None above the root."""
    prim = on_stage(prim)
    for _ in range(levels):
        if prim.IsPseudoRoot():
            return None
        prim = prim.GetParent()
    return prim


def _selections(prim: Any) -> Iterator[tuple[int, str, str]]:
    """The selections of a prim and of those above it, each with how many levels above it is."""
    above, levels = on_stage(prim), 0
    while not above.IsPseudoRoot():
        if above.HasVariantSets():
            for name, variant in above.GetVariantSets().GetAllVariantSelections().items():
                yield levels, name, variant
        above, levels = above.GetParent(), levels + 1
