"""Which prims each rule is handed: those of its schemas that pass its precondition."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from operator import itemgetter
from typing import Any, TypeAlias

from usdvol_lint import schema
from usdvol_lint.engine.failures import PACK_FAILURES
from usdvol_lint.facts import Facts, Walked
from usdvol_lint.facts.prims.tables import Chunk, Table
from usdvol_lint.facts.usd.diagnostics import UNREADABLE
from usdvol_lint.facts.usd.kinds import KindKey
from usdvol_lint.rule import Rule, When

Options: TypeAlias = Mapping[str, Mapping[str, Any]]
"""The options of rules, by code."""
Failed: TypeAlias = Callable[[Sequence[Rule], BaseException], None]
"""Called with rules whose precondition raised; they are handed the prims all the same."""


def assign(
    walked: Walked, rules: Iterable[Rule], facts: Facts, options: Options, failed: Failed
) -> Iterator[tuple[Rule, Any]]:
    """Each rule with each kept prim of its schemas that passes its precondition.

    `Rule.when` is evaluated once for all prims that share a key, and keys are computed only for
    prims that some rule with a precondition asks for.
    """
    rules = list(rules)
    subscriptions = {
        key: _Subscription(facts.kinds.names(key), rules, facts, options, failed)
        for key in walked.kept
    }
    for key, chunk in _fields_first(walked, facts):
        for prim in chunk.prims:
            for rule in subscriptions[key].always:
                yield rule, prim
        if subscriptions[key].by_keys:
            for table in facts.tables.tables(chunk):
                for rules_by_key in subscriptions[key].by_keys:
                    yield from rules_by_key.chosen(table)


class _Subscription:
    """The rules for prims of one kind: without a precondition, and the others by their keys."""

    def __init__(
        self,
        names: frozenset[str],
        rules: Iterable[Rule],
        facts: Facts,
        options: Options,
        failed: Failed,
    ) -> None:
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
            _RulesByKey(declared, facts, chosen, options, failed)
            for declared, chosen in narrowed.items()
        ]


class _RulesByKey:
    """The rules whose preconditions look at one column of keys, evaluated once for each key."""

    def __init__(
        self,
        declared: Any,
        facts: Facts,
        rules: list[tuple[Rule, When]],
        options: Options,
        failed: Failed,
    ) -> None:
        self._declared = declared
        self._wing = facts.wing(declared.owner)
        self._rules = rules
        self._options = options
        self._failed = failed
        self._chosen: dict[Any, list[Rule]] = {}

    def chosen(self, table: Table) -> Iterator[tuple[Rule, Any]]:
        """The prims of a table, each with every rule that its key passes."""
        keys = self._keys(table)
        if keys is None:
            yield from self._one_by_one(table)
            return
        # In the order of the prims: if a precondition fails on several keys, it reports the first.
        rules = {key: self._rules_for(key) for key in dict.fromkeys(keys)}
        if any(rules.values()):
            for prim, key in zip(table.prims, keys, strict=True):
                for rule in rules[key]:
                    yield rule, prim

    def _one_by_one(self, table: Table) -> Iterator[tuple[Rule, Any]]:
        """The same, prim by prim; a prim whose key can't be computed is handed to all rules."""
        if len(table.prims) == 1:
            yield from ((rule, table.prims[0]) for rule, _ in self._rules)
            return
        for row in range(len(table.prims)):
            yield from self.chosen(table.alone(row))

    def _keys(self, table: Table) -> list[Any] | None:
        try:
            return list(self._declared.keys(self._wing, table))
        except UNREADABLE:
            pass  # the rules meet the same error, and report it
        except PACK_FAILURES as error:  # reported once it fails on one prim alone
            if len(table.prims) == 1:
                self._failed([rule for rule, _ in self._rules], error)
        return None

    def _rules_for(self, key: Any) -> list[Rule]:
        if key not in self._chosen:
            self._chosen[key] = [rule for rule, when in self._rules if self._holds(rule, when, key)]
        return self._chosen[key]

    def _holds(self, rule: Rule, when: When, key: Any) -> bool:
        given = {**rule.options, **self._options.get(rule.code, {})}
        try:
            return bool(when.holds(key, **{name: given[name] for name in when.options}))
        except PACK_FAILURES as error:
            self._failed([rule], error)
            return True


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
