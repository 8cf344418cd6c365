"""Defined prims that are not on the stage because a prim above them is only an `over`."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator
from functools import cached_property
from typing import Any, NamedTuple

from pxr import Sdf

from usdvol_lint.facts.usd.calls import get_path
from usdvol_lint.facts.usd.instances import in_prototype, shown
from usdvol_lint.nearest import is_one_slip_from

_PROTOTYPES = "prototypes"


class Undefined(NamedTuple):
    """An `over` that no layer defines, and the topmost prims of ours with a `def` below it.

    `similar` is the path of a defined sibling with nearly the same name; None if there is none.
    """

    over: Any
    prims: tuple[Any, ...]
    similar: str | None


def find_undefined(
    stage: Any, prims: Iterable[Any], may_lack: Callable[[Any], bool]
) -> Iterator[Undefined]:
    """The overs that take some of these prims off the stage, where that is probably a slip.

    An `over` without a defined prim above it is left out, unless a sibling has nearly its name:
    a layer of overs is meant to be composed below another one.
    So is a library, which an arc or a PointInstancer brings onto the stage from below the `over`.
    `may_lack` tells whether a layer that did not open may define a prim.
    """
    arcs = _Arcs(stage)
    faulty = _faulty(stage)
    below: dict[Any, list[Any]] = defaultdict(list)
    for prim in prims:
        below[_topmost_undefined(prim)].append(prim)
    for over, found in sorted(below.items(), key=lambda item: item[0].GetPath()):
        similar = _similar_sibling(over)
        if not similar and over.GetParent().IsPseudoRoot():
            continue
        is_sure = not may_lack(over) and faulty.isdisjoint(over.GetPath().GetPrefixes())
        if is_sure and not _has_unselected_variants(over) and not arcs.meet(over):
            yield Undefined(over, tuple(_topmost(found)), similar)


def _faulty(stage: Any) -> frozenset[Any]:
    """The paths of the prims with an arc that brought nothing, as the walk visits them."""
    prims = [stage.GetPrimAtPath(error.rootSite.path) for error in stage.GetCompositionErrors()]
    prims += [prim.GetPrototype() for prim in prims if prim and prim.IsInstance()]
    return frozenset(in_prototype(prim).GetPath() for prim in prims if prim)


def _topmost_undefined(prim: Any) -> Any:
    while not (above := prim.GetParent()).IsDefined():
        prim = above
    return prim


def _similar_sibling(over: Any) -> str | None:
    """The path of a defined sibling whose name is one slip away; None where there are several."""
    siblings = [
        sibling
        for sibling in over.GetParent().GetChildren()
        if is_one_slip_from(over.GetName(), sibling.GetName())
    ]
    return shown(siblings[0]).path if len(siblings) == 1 else None


def _has_unselected_variants(prim: Any) -> bool:
    """Whether another variant of the prim or of one above it might define it."""
    while not prim.IsPseudoRoot():
        sets = prim.GetVariantSets()
        for name in sets.GetNames():
            selectable = set(sets.GetVariantSet(name).GetVariantNames())
            if selectable - {sets.GetVariantSelection(name)}:
                return True
        prim = prim.GetParent()
    return False


def _topmost(prims: Iterable[Any]) -> Iterator[Any]:
    """Those of the prims that are not below another of them, by path."""
    last = Sdf.Path.emptyPath
    for prim in sorted(prims, key=get_path):
        if last.isEmpty or not prim.GetPath().HasPrefix(last):
            last = prim.GetPath()
            yield prim


class _Arcs:
    """Where the arcs inside of layers lead, selected or not; read only if there is a question."""

    def __init__(self, stage: Any) -> None:
        self._stage = stage

    def meet(self, over: Any) -> bool:
        """Whether an arc leads to an `over`, below it or above it, in one of its layers."""
        paths = {spec.path.StripAllVariantSelections() for spec in over.GetPrimStack()}
        above = {prefix for path in paths for prefix in path.GetPrefixes()}
        return not paths.isdisjoint(self._with_prefixes) or not above.isdisjoint(self._targets)

    @cached_property
    def _with_prefixes(self) -> frozenset[Any]:
        return frozenset(prefix for target in self._targets for prefix in target.GetPrefixes())

    @cached_property
    def _targets(self) -> frozenset[Any]:
        targets: set[Any] = set()
        for layer in self._stage.GetUsedLayers():
            layer.Traverse(
                Sdf.Path.absoluteRootPath,
                lambda path, layer=layer: targets.update(_targets_at(layer, path)),
            )
        return frozenset(target.StripAllVariantSelections() for target in targets)


def _targets_at(layer: Any, path: Any) -> Iterator[Any]:
    """The paths inside of the layer that arcs on this spec lead to."""
    if path.IsPropertyPath():
        if path.name == _PROTOTYPES and (relationship := layer.GetRelationshipAtPath(path)):
            yield from relationship.targetPathList.GetAddedOrExplicitItems()
        return
    is_of_prim = path.IsPrimPath() or path.IsPrimVariantSelectionPath()
    spec = layer.GetPrimAtPath(path) if is_of_prim else None
    if not spec:
        return
    for key in filter(spec.HasInfo, ("inheritPaths", "specializes")):
        yield from spec.GetInfo(key).GetAppliedItems()
    for key in filter(spec.HasInfo, ("references", "payload")):
        arcs = spec.GetInfo(key).GetAppliedItems()
        yield from (arc.primPath for arc in arcs if not arc.assetPath and arc.primPath)
