"""Traverses a stage once, and keeps every drawn prim that some rule asks for, by kind."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Generator, Iterable, Iterator, Mapping, Sequence
from itertools import compress, filterfalse, islice, repeat
from typing import Any

from pxr import Usd

from usdvol_lint import schema
from usdvol_lint.facts import Walked
from usdvol_lint.facts.usd.calls import (
    COMPOSED,
    get_children,
    get_parent,
    has_metadata,
    has_specifier,
    is_defined,
)
from usdvol_lint.facts.usd.drawn import Drawn
from usdvol_lint.facts.usd.instances import Standing, standing_of
from usdvol_lint.facts.usd.kinds import KindKey, PrimKinds
from usdvol_lint.facts.usd.settled import settle
from usdvol_lint.facts.usd.untyped import GROUP_TYPES, overs_with_our_data, with_our_data
from usdvol_lint.rule import Rule

_BATCH = 256
"""Prims in memory at once: all 200,000 prims of a stage take 50 MB, and no less time.

From 64 to 4,096 the time is the same.
"""
_GROUPS = 20_000
"""How many prims without a type, Xforms and Scopes are looked into, the first ones.

To ask a prim for what is authored on it takes as long as all else that the walk asks.
"""
_FEW = 32
"""So many prims are met through their children, since USD's iterator ends by an exception of C++.

That takes as long as to ask 20 prims.
"""
_OVERS = 20_000
"""How many overs are kept, the first ones: a layer that is meant for another has no others."""


def asked_by(rules: Iterable[Rule]) -> frozenset[str]:
    """The schemas of the prims that a walk keeps for these rules."""
    return schema.OURS.union(*(rule.on for rule in rules))


def walk(stage: Any, asked_for: frozenset[str], kinds: PrimKinds) -> Walked:
    """Walks the stage and each prototype once; skips abstract, inactive and unloaded prims."""
    standings = {prototype: standing_of(prototype) for prototype in stage.GetPrototypes()}
    met = _Met(asked_for | {schema.POINT_INSTANCER}, kinds)
    for prims in _batches(stage, standings):
        met.add(prims)
    instancers = met.of_kinds(frozenset({schema.POINT_INSTANCER}))
    drawn = Drawn(prim for _, prims in instancers for prim in prims)
    unsure = [each for each, standing in standings.items() if standing is Standing.UNDEFINED]
    shows_all = all(map(drawn.appears, unsure))
    kept: dict[KindKey, list[Any]] = {}
    undefined: dict[Any, list[Any]] = defaultdict(list)
    above = _Above(drawn)
    for key, prims in met.of_kinds(asked_for):
        if shows_all and all(map(is_defined, prims)):
            kept[key] = prims
            continue
        met.overs += overs_with_our_data(prims)
        if not schema.OURS.isdisjoint(kinds.names(key)):
            for prim in filter(has_specifier, filterfalse(drawn.__contains__, prims)):
                for over in above.overs(prim):
                    undefined[over].append(prim)
        if shown := list(filter(drawn.__contains__, prims)):
            kept[key] = shown
    untyped = list(filter(drawn.__contains__, met.untyped))
    return Walked(met.count, kept, met.clipped, untyped, undefined, met.overs, drawn)


class _Met:
    """What the walk met: how many prims, those of the kinds that are wanted, and some others.

    Whether a kind is wanted is decided once for each combination of type and applied schemas, so
    the cost does not grow with the number of rules.
    """

    def __init__(self, wanted: frozenset[str], kinds: PrimKinds) -> None:
        self.count = 0
        self.clipped: list[Any] = []
        self.untyped: list[Any] = []
        self.overs: list[Any] = []
        self._wanted = wanted
        self._kinds = kinds
        self._known: set[KindKey] = set()
        self._of_kind: dict[KindKey, list[Any]] = {}
        self._above: set[Any] = set()
        self._groups: set[KindKey] = set()
        self._typeless: set[KindKey] = set()
        self._groups_left = _GROUPS

    def add(self, prims: Sequence[Any]) -> None:
        """Adds prims that the walk met one after the other."""
        self.count += len(prims)
        keys = self._kinds.keys(prims)
        here = set(keys)
        if not here <= self._known:
            self._learn(keys)
        if not here.isdisjoint(self._of_kind):
            self._keep(prims, keys)
        if self._groups_left > 0 and not here.isdisjoint(self._groups):
            groups = list(compress(prims, map(self._groups.__contains__, keys)))
            self._groups_left -= len(groups)
            self.untyped += with_our_data(groups)
        if len(self.overs) < _OVERS and not here.isdisjoint(self._typeless):
            typeless = compress(prims, map(self._typeless.__contains__, keys))
            self.overs += overs_with_our_data(typeless)

    def _learn(self, keys: Iterable[KindKey]) -> None:
        for key in dict.fromkeys(keys):
            if key not in self._known:
                self._known.add(key)
                if not self._wanted.isdisjoint(self._kinds.names(key)):
                    self._of_kind[key] = []
                if key[0] in GROUP_TYPES:
                    self._groups.add(key)
                if not key[0]:
                    self._typeless.add(key)

    def _keep(self, prims: Sequence[Any], keys: Iterable[KindKey]) -> None:
        around: list[Any] = []
        is_run = False
        for prim, kept in zip(prims, map(self._of_kind.get, keys), strict=True):
            if kept is not None:
                kept.append(prim)
                # Depth first: an ancestor of one of a run is among them, or one of the first.
                around += (prim,) if is_run else (prim, *self._new_above(prim))
            is_run = kept is not None
        self.clipped += compress(around, map(has_metadata, around, repeat("clips")))

    def _new_above(self, prim: Any) -> Iterator[Any]:
        """The ancestors of a prim that were not asked for clips before."""
        while not (prim := get_parent(prim)).IsPseudoRoot() and prim not in self._above:
            self._above.add(prim)
            yield prim

    def of_kinds(self, wanted: frozenset[str]) -> Iterator[tuple[KindKey, list[Any]]]:
        """The prims of each kind that answers to one of these schemas."""
        for key, prims in self._of_kind.items():
            if prims and not wanted.isdisjoint(self._kinds.names(key)):
                yield key, prims


class _Above:
    """What is above prims that are not drawn; what is found for a prim is kept."""

    def __init__(self, drawn: Drawn) -> None:
        self._drawn = drawn
        self._tops: dict[Any, Any] = {}
        self._overs: dict[Any, list[Any]] = {}

    def overs(self, prim: Any) -> list[Any]:
        """The prims right below the first that is drawn, above each instance that has the prim."""
        return settle(self._top(prim), self._find_overs, self._overs)

    def _top(self, prim: Any) -> Any:
        """The prim right below the first that is drawn, or the prototype that the prim is in."""
        passed = []
        while prim not in self._tops:
            passed.append(prim)
            above = None if prim.IsPrototype() else get_parent(prim)
            if above is None or above in self._drawn:
                self._tops[prim] = prim
            else:
                prim = above
        self._tops.update(dict.fromkeys(passed, self._tops[prim]))
        return self._tops[prim]

    def _find_overs(self, top: Any) -> Generator[Any, None, list[Any]]:
        if not top.IsPrototype():
            return [top]
        found: dict[Any, None] = {}
        for instance in filter(COMPOSED, top.GetInstances()):
            above = self._top(instance)
            if above not in self._overs:
                yield above
            found.update(dict.fromkeys(self._overs[above]))
        return list(found)


def _batches(stage: Any, prototypes: Mapping[Any, Standing]) -> Iterator[list[Any]]:
    few = [] if prototypes else _few(stage.GetPseudoRoot())
    if few:
        yield few
        return
    ranges = (
        Usd.PrimRange(root, COMPOSED)
        for root, standing in prototypes.items()
        if standing is not Standing.ABSTRACT
    )
    for prims in (Usd.PrimRange.Stage(stage, COMPOSED), *ranges):
        iterator = iter(prims)
        batch = list(islice(iterator, _BATCH))
        while batch:
            yield batch
            # USD's iterator ends by an exception of C++, which is slow: it is met once.
            is_last = len(batch) < _BATCH
            batch = [] if is_last else list(islice(iterator, _BATCH))


def _few(root: Any) -> list[Any]:
    """All prims below this one, depth first, as USD's iterator has them; none of more than a few.

    An empty stage has none either.
    """
    met: list[Any] = []
    waiting = get_children(root, COMPOSED)[::-1]
    while waiting and len(met) + len(waiting) <= _FEW:
        prim = waiting.pop()
        met.append(prim)
        waiting += get_children(prim, COMPOSED)[::-1]
    return [] if waiting else met
