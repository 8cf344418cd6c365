"""Counts what USD composes of a layer, without composing again what is there already."""

from __future__ import annotations

from collections.abc import Callable, Generator, Hashable
from typing import Any, NamedTuple, TypeAlias

from pxr import Ar, Pcp, Sdf, Usd

from usdvol_lint.facts.usd.nodes import nodes_of
from usdvol_lint.facts.usd.settled import settle

_MOST_INDICES = 20_000
"""So many prims are looked at, in a second or two: where more differ, they are no bomb of a few."""


class Size(NamedTuple):
    """How many prims there are, and of how many places in layer stacks they are composed.

    `different` of the prims bring each something below that no other one brings; `again` is the
    first of those with most below it that are there more than once, if any are.
    """

    prims: int
    sites: int
    different: int = 0
    again: str | None = None


_Key: TypeAlias = tuple[bool, Hashable]
"""Whether a prim is an instance, and what it is composed of: two of one key are alike below."""


def size_of(
    layer: Any, session: Any | None, loads: bool, goes_on: Callable[[], bool] = lambda: True
) -> Size:
    """What USD composes of a root layer, at least.

    What is alike is counted once and multiplied; what instances share is there once.  It is no more
    than was found until `goes_on` says no.
    """
    context = Ar.GetResolver().CreateDefaultContextForAsset(layer.identifier)
    with Ar.ResolverContextBinder(context):
        return _Composing(layer, session, context, loads, goes_on).size()


class _Composing:
    def __init__(
        self, layer: Any, session: Any, context: Any, loads: bool, goes_on: Callable[[], bool]
    ) -> None:
        self._cache = Pcp.Cache(Pcp.LayerStackIdentifier(layer, session, context), "usd", True)
        self._cache.SetVariantFallbacks(Usd.Stage.GetGlobalVariantFallbacks())
        self._loads = loads
        self._goes_on = goes_on
        self._left = _MOST_INDICES
        self._below: dict[_Key, Size] = {}
        self._first: dict[_Key, Any] = {}
        self._repeated: dict[_Key, None] = {}  # in the order in which they are met

    def size(self) -> Size:
        root, _ = self._met(Sdf.Path.absoluteRootPath)
        settle(root, self._find_below, self._below)
        # An instance is one prim of what is above it, and what it shares is there beside that.
        there = [size for key, size in self._below.items() if key == root or key[0]]
        prims, sites = sum(each.prims for each in there), sum(each.sites for each in there)
        repeated = max(self._repeated, key=lambda each: self._below[each].sites, default=None)
        again = None if repeated is None else str(self._first[repeated])
        return Size(prims, sites, len(self._below), again)

    def _met(self, path: Any) -> tuple[_Key, int]:
        """The key of a prim, and of how many places it is composed."""
        self._left -= 1
        index = self._index(path)
        nodes = list(nodes_of(index))
        key = _instance_key(nodes) if index.IsInstanceable() else _key(nodes)
        self._first.setdefault(key, path)
        return key, len(nodes)

    def _index(self, path: Any) -> Any:
        index, _ = self._cache.ComputePrimIndex(path)
        if self._loads and index.hasAnyPayloads and not self._cache.IsPayloadIncluded(path):
            self._cache.RequestPayloads([path], [])
            index, _ = self._cache.ComputePrimIndex(path)
        return index

    def _find_below(self, key: _Key) -> Generator[_Key, None, Size]:
        path = self._first[key]
        index = self._index(path)
        names, _ = index.ComputePrimChildNames() if _is_active(index) else ((), ())
        prims = sites = 0
        for name in names:
            if self._left <= 0 or not self._goes_on():
                break
            child, own = self._met(path.AppendChild(name))
            if child in self._below:
                self._repeated[child] = None
            else:
                yield child
            below = Size(0, 0) if child[0] else self._below[child]
            prims += 1 + below.prims
            sites += own + below.sites
        return Size(prims, sites)


def _key(nodes: list[Any]) -> _Key:
    """What is below hangs on the places that hold a spec, and on the layer stacks around them."""
    places = ((each.layerStack.identifier, each.path if each.hasSpecs else None) for each in nodes)
    return False, tuple(places)


def _instance_key(nodes: list[Any]) -> _Key:
    """Of an instance, its own opinions and those that it has from above it do not count.

    USD tells apart more than that.
    """
    brought = (each for each in nodes[1:] if each.hasSpecs and each.HasTransitiveDirectDependency())
    return True, frozenset((each.layerStack.identifier, each.path) for each in brought)


def _is_active(index: Any) -> bool:
    said = (spec.GetInfo("active") for spec in index.primStack if spec.HasInfo("active"))
    return bool(next(said, True))
