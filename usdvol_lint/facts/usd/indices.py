"""Prim indices that are the same in each run, also of prims in prototypes."""

from __future__ import annotations

from typing import Any
from weakref import WeakKeyDictionary

from pxr import Ar, Pcp, Usd

from usdvol_lint.facts.usd.calls import get_index, is_in_prototype
from usdvol_lint.facts.usd.instances import forget_prototypes, in_prototype, prototype_of, shown


class _Composed:
    """What USD composes at paths of a stage, whatever instance it made a prototype of."""

    def __init__(self, stage: Any) -> None:
        layers = stage.GetRootLayer(), stage.GetSessionLayer()
        self._context = stage.GetPathResolverContext()
        self._rules = stage.GetLoadRules()
        identifier = Pcp.LayerStackIdentifier(*layers, self._context)
        self._cache = Pcp.Cache(identifier, "usd", True)
        self._cache.SetVariantFallbacks(Usd.Stage.GetGlobalVariantFallbacks())
        self._first: dict[Any, Any] = {}

    def of(self, prim: Any) -> Any:
        """The index of a prim in a prototype, as at the first of its paths on the stage."""
        prototype = prototype_of(prim)
        if prototype not in self._first:
            self._first[prototype] = shown(prototype).path
        path = prim.GetPath().ReplacePrefix(prototype.GetPath(), self._first[prototype])
        loaded = [each for each in path.GetPrefixes() if self._rules.IsLoaded(each)]
        with Ar.ResolverContextBinder(self._context):
            self._cache.RequestPayloads(loaded, [])
            index, _ = self._cache.ComputePrimIndex(path)
        return index


_COMPOSED: WeakKeyDictionary[Any, _Composed] = WeakKeyDictionary()


def index_of(prim: Any) -> Any:
    """The prim index of a prim: where it comes from, with the paths of the first that shows it.

    USD makes a prototype of any of its instances, in each run of another one, and a prim index has
    the paths of that one.  The root of a prototype has none.
    """
    prim = in_prototype(prim)
    if not is_in_prototype(prim) or prim.IsPrototype():
        return get_index(prim)
    stage = prim.GetStage()
    if stage not in _COMPOSED:
        _COMPOSED[stage] = _Composed(stage)
    return _COMPOSED[stage].of(prim)


def recomposed(stage: Any) -> None:
    """Says that a stage was composed in another way."""
    _COMPOSED.pop(stage, None)
    forget_prototypes(stage)
