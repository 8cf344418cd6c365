"""Which prims each rule is handed: those of its schemas that pass its precondition."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from enum import Enum
from operator import itemgetter
from types import NoneType
from typing import Any, TypeAlias

from usdvol_lint import schema
from usdvol_lint.engine.trouble import PACK_FAILURES
from usdvol_lint.engine.walk import asked_by
from usdvol_lint.facts import Facts, Walked
from usdvol_lint.facts.prims.tables import Chunk, Table
from usdvol_lint.facts.usd.diagnostics import UNREADABLE
from usdvol_lint.facts.usd.kinds import KindKey
from usdvol_lint.rule import Rule, When

Options: TypeAlias = Mapping[str, Mapping[str, Any]]
"""The options of rules, by code."""
Failed: TypeAlias = Callable[[Sequence[Rule], BaseException], None]
"""Called with rules whose precondition raised; they are handed the prims all the same."""

_GROUPS = (tuple, frozenset)
_PLAIN = (NoneType, bool, int, float, str, Enum)

_MOST_KEYS = 10_000
"""So many keys are kept over all stages."""


class Assignment:
    """Hands prims to rules: what a kind or a key of prims decides is decided once for all stages.

    `Rule.when` is evaluated once for all prims that share a key, and keys are computed only for
    prims that some rule with a precondition asks for.
    """

    def __init__(self, rules: Iterable[Rule], options: Options) -> None:
        self._rules = list(rules)
        self._options = options
        self._subscriptions: dict[frozenset[str], _Subscription] = {}
        self.asked_for = asked_by(self._rules)
        """The schemas of the prims that are to be handed."""

    def pairs(
        self, walked: Walked, facts: Facts, failed: Failed
    ) -> Iterator[tuple[Rule, Any] | None]:
        """Each rule with each kept prim of its schemas that passes its precondition.

        None where another stage may go on.
        """
        for key, chunk in _fields_first(walked, facts):
            wanted = self._subscription(facts.kinds.names(key))
            yield None
            for prim in chunk.prims:
                for rule in wanted.always:
                    yield rule, prim
            if wanted.by_keys:
                for table in facts.tables.tables(chunk):
                    for rules_by_key in wanted.by_keys:
                        yield None
                        yield from rules_by_key.chosen(table, facts, failed)

    def _subscription(self, names: frozenset[str]) -> _Subscription:
        if names not in self._subscriptions:
            self._subscriptions[names] = _Subscription(names, self._rules, self._options)
        return self._subscriptions[names]


class _Subscription:
    """The rules for prims of one kind: without a precondition, and the others by their keys."""

    def __init__(self, names: frozenset[str], rules: Iterable[Rule], options: Options) -> None:
        self.always: list[Rule] = []
        narrowed: dict[Any, list[tuple[Rule, When]]] = defaultdict(list)
        for rule in rules:
            if names.isdisjoint(rule.on):
                continue
            if rule.when:
                narrowed[rule.when.keys].append((rule, rule.when))
            else:
                self.always.append(rule)
        self.by_keys = [
            _RulesByKey(declared, chosen, options) for declared, chosen in narrowed.items()
        ]


class _RulesByKey:
    """The rules whose preconditions look at one column of keys, evaluated once for each key."""

    def __init__(self, declared: Any, rules: list[tuple[Rule, When]], options: Options) -> None:
        self._declared = declared
        self._rules = rules
        self._given = {rule.code: _given(rule, when, options) for rule, when in rules}
        self._chosen: dict[Any, list[Rule]] = {}

    def chosen(self, table: Table, facts: Facts, failed: Failed) -> Iterator[tuple[Rule, Any]]:
        """The prims of a table, each with every rule that its key passes."""
        keys = self._keys(table, facts, failed)
        if keys is None:
            yield from self._one_by_one(table, facts, failed)
            return
        if len(keys) == 1:  # as on most small stages, of which there are many
            for rule in self._rules_for(keys[0], failed):
                yield rule, table.prims[0]
            return
        # In the order of the prims: if a precondition fails on several keys, it reports the first.
        rules = {key: self._rules_for(key, failed) for key in dict.fromkeys(keys)}
        if any(rules.values()):
            for prim, key in zip(table.prims, keys, strict=True):
                for rule in rules[key]:
                    yield rule, prim

    def _one_by_one(self, table: Table, facts: Facts, failed: Failed) -> Iterator[tuple[Rule, Any]]:
        """The same, prim by prim; a prim whose key can't be computed is handed to all rules."""
        if len(table.prims) == 1:
            yield from ((rule, table.prims[0]) for rule, _ in self._rules)
            return
        for row in range(len(table.prims)):
            yield from self.chosen(table.alone(row), facts, failed)

    def _keys(self, table: Table, facts: Facts, failed: Failed) -> list[Any] | None:
        try:
            return list(self._declared.keys(facts.wing(self._declared.owner), table))
        except UNREADABLE:
            pass  # the rules meet the same error, and report it
        except PACK_FAILURES as error:  # reported once it fails on one prim alone
            if len(table.prims) == 1:
                failed([rule for rule, _ in self._rules], error)
        return None

    def _rules_for(self, key: Any, failed: Failed) -> list[Rule]:
        known = self._chosen.get(key)
        if known is not None:
            return known
        failures: list[tuple[Rule, BaseException]] = []
        found = [rule for rule, when in self._rules if self._holds(rule, when, key, failures)]
        for rule, error in failures:
            failed([rule], error)
        # What fails is told on each stage, and a key that is of one stage would keep it in memory.
        if not failures and _lasts(key):
            if len(self._chosen) >= _MOST_KEYS:
                self._chosen.clear()  # what is known of contents was forgotten meanwhile
            self._chosen[key] = found
        return found

    def _holds(
        self, rule: Rule, when: When, key: Any, failures: list[tuple[Rule, BaseException]]
    ) -> bool:
        try:
            return bool(when.holds(key, **self._given[rule.code]))
        except PACK_FAILURES as error:
            failures.append((rule, error))
            return True


def _lasts(key: Any) -> bool:
    """Whether a key is plain data, or says that it is of no stage."""
    if isinstance(key, _GROUPS):
        return all(map(_lasts, key))
    return isinstance(key, _PLAIN) or hasattr(key, "LASTS")


def _given(rule: Rule, when: When, options: Options) -> dict[str, Any]:
    """The options that a precondition is given."""
    given = {**rule.options, **options.get(rule.code, {})}
    return {name: given[name] for name in when.options}


def _fields_first(walked: Walked, facts: Facts) -> Iterator[tuple[KindKey, Chunk]]:
    """The kept prims in chunks of one kind, roughly in the order of the walk.

    Facts about Volumes need facts about their fields: of prims that the walk met together, fields
    come first, and their facts are still in the processor's cache when the Volumes follow.
    """
    order = []
    for key in walked.kept:
        later = schema.FIELD not in facts.kinds.names(key)
        chunks = facts.tables.chunks(key)
        order += [((n / len(chunks), later, key), chunk) for n, chunk in enumerate(chunks, 1)]
    yield from ((key, chunk) for (_, _, key), chunk in sorted(order, key=itemgetter(0)))
