"""One traversal of the stage: every live prim, handed to the rules that asked for its schema."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from itertools import compress, islice, repeat
from operator import itemgetter
from typing import Any, TypeAlias

from pxr import Usd

from usdvol_lint import schema
from usdvol_lint.facts import Facts
from usdvol_lint.facts.prims.tables import Chunk, Table
from usdvol_lint.facts.sums import Sums
from usdvol_lint.facts.usd.calls import has_metadata
from usdvol_lint.facts.usd.kinds import Key, Kinds
from usdvol_lint.rule import Rule

_BATCH = 256
"""Small enough that its objects are gone before the garbage collector looks at them."""
Options: TypeAlias = Mapping[str, Mapping[str, Any]]
"""The options of rules, by code."""

_COUNTED = frozenset({schema.VOLUME, schema.FIELD, schema.PARTICLE_FIELD})


@dataclass(slots=True)
class Walk:
    """What the walk saw: how many prims, and those that some rule wants, by kind.

    `clipped` are those among them and their ancestors on which value clips are authored, and maybe
    others.
    """

    prims: int = 0
    clipped: list[Any] = field(default_factory=list)
    kept: dict[Key, list[Any]] = field(default_factory=dict)


def walk(stage: Any, rules: Iterable[Rule], kinds: Kinds) -> Walk:
    """Walks the stage and each prototype once; abstract, inactive and unloaded prims stay outside.

    Whether a prim is kept is decided once for each combination of type and applied schemas, so
    the cost does not grow with the number of rules.
    """
    wanted = _COUNTED.union(*(rule.on for rule in rules))
    of_kind: dict[Key, list[Any] | None] = {}
    result = Walk()
    for prims in _batches(stage):
        result.prims += len(prims)
        keeps_some = False
        for prim, key in zip(prims, kinds.keys(prims), strict=True):
            if key not in of_kind:
                of_kind[key] = None if wanted.isdisjoint(kinds.names(key)) else []
            kept = of_kind[key]
            if kept is not None:
                kept.append(prim)
                keeps_some = True
        if keeps_some:
            # The walk goes down first: all that is above one of them is here or above the first.
            around = [*_ancestors(prims[0]), *prims]
            result.clipped += compress(around, map(has_metadata, around, repeat("clips")))
    result.kept = {key: kept for key, kept in of_kind.items() if kept}
    return result


def assign(
    walked: Walk, rules: Iterable[Rule], facts: Facts, options: Options
) -> Iterator[tuple[Rule, Any]]:
    """Each rule with each kept prim that it asked for.

    A prim that nothing is remarkable about is handed to few: `Rule.when` is asked once for all
    prims that are alike, and what sums up a prim is found for those alone that are asked for it.
    """
    rules = list(rules)
    sums = Sums(facts)
    asking = {key: _Asking(facts.kinds.names(key), rules, sums, options) for key in walked.kept}
    for key, chunk in _fields_first(walked, facts):
        for prim in chunk.prims:
            for rule in asking[key].always:
                yield rule, prim
        if asking[key].triages:
            for table in facts.tables(chunk):
                for triage in asking[key].triages:
                    yield from triage.chosen(table)


class _Asking:
    """The rules that ask for prims of a kind: `always`, or for those that a triage chooses."""

    def __init__(
        self, names: frozenset[str], rules: Iterable[Rule], sums: Sums, options: Options
    ) -> None:
        by_fact: dict[str, list[Rule]] = defaultdict(list)
        self.always: list[Rule] = []
        for rule in rules:
            if not names.isdisjoint(rule.on):
                (by_fact[rule.when.fact] if rule.when else self.always).append(rule)
        self.triages = [
            _Triage(getattr(sums, fact), chosen, options) for fact, chosen in by_fact.items()
        ]


class _Triage:
    """The rules that go by one fact, chosen once for each sum that it gives."""

    def __init__(
        self,
        sum_up: Callable[[Table], Iterable[Any]],
        rules: list[Rule],
        options: Options,
    ) -> None:
        self._sum_up = sum_up
        self._rules = rules
        self._options = options
        self._known: dict[Any, list[Rule]] = {}

    def chosen(self, table: Table) -> Iterator[tuple[Rule, Any]]:
        """The prims, each with its rules; what can't be told here, they find out themselves."""
        sums: list[Any] | None = None
        with suppress(Exception):
            sums = list(self._sum_up(table))
        if sums is None:
            if len(table.prims) == 1:
                yield from ((rule, table.prims[0]) for rule in self._rules)
                return
            for row in range(len(table.prims)):
                yield from self.chosen(table.alone(row))
            return
        chosen = {found: self._rules_for(found) for found in set(sums)}
        if any(chosen.values()):
            for prim, found in zip(table.prims, sums, strict=True):
                for rule in chosen[found]:
                    yield rule, prim

    def _rules_for(self, found: Any) -> list[Rule]:
        if found not in self._known:
            self._known[found] = [rule for rule in self._rules if self._holds(rule, found)]
        return self._known[found]

    def _holds(self, rule: Rule, found: Any) -> bool:
        try:
            options = {**rule.options, **self._options.get(rule.code, {})}
            return not rule.when or rule.when.holds(found, **options)
        except Exception:
            return True


def _ancestors(prim: Any) -> Iterator[Any]:
    while not (prim := prim.GetParent()).IsPseudoRoot():
        yield prim


def _fields_first(walked: Walk, facts: Facts) -> Iterator[tuple[Key, Chunk]]:
    """The kept prims by kind, some at a time, roughly in the order of the walk.

    What Volumes are asked needs what their fields hold: of prims that the walk met together, so
    that what is found of them is cached, fields come first.
    """
    order = []
    for key in walked.kept:
        later = schema.FIELD not in facts.kinds.names(key)
        chunks = facts.chunks(key)
        order += [((n / len(chunks), later, key), chunk) for n, chunk in enumerate(chunks, 1)]
    yield from ((key, chunk) for (_, _, key), chunk in sorted(order, key=itemgetter(0)))


def _batches(stage: Any) -> Iterator[list[Any]]:
    roots = [stage.Traverse(), *(Usd.PrimRange(root) for root in stage.GetPrototypes())]
    for prims in roots:
        iterator = iter(prims)
        while batch := list(islice(iterator, _BATCH)):
            yield batch
