"""One traversal of the stage: every live prim, handed to the rules that asked for its schema."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import islice
from typing import Any, TypeAlias

from pxr import Usd

from usdvol_lint import schema
from usdvol_lint.facts import Facts
from usdvol_lint.facts.kinds import Key, Kinds
from usdvol_lint.facts.sums import Sums
from usdvol_lint.rule import Rule

_CHUNK = 1024
"""So many prims are asked one question after the other: then what is found of them is cached."""
_BATCH = 256
"""Small enough that its objects are gone before the garbage collector looks at them."""
Options: TypeAlias = Mapping[str, Mapping[str, Any]]
"""The options of rules, by code."""

_COUNTED = frozenset({schema.VOLUME, schema.FIELD, schema.PARTICLE_FIELD})


@dataclass(slots=True)
class Walk:
    """What the walk saw: how many prims, and those that some rule wants, by kind."""

    prims: int = 0
    kept: dict[Key, list[Any]] = field(default_factory=lambda: defaultdict(list))


def walk(stage: Any, rules: Iterable[Rule], kinds: Kinds) -> Walk:
    """Walks the stage and each prototype once; abstract, inactive and unloaded prims stay outside.

    Whether a prim is kept is decided once for each combination of type and applied schemas, so
    the cost does not grow with the number of rules.
    """
    wanted = _COUNTED.union(*(rule.on for rule in rules))
    decided: dict[Key, bool] = {}
    result = Walk()
    for prims in _batches(stage):
        result.prims += len(prims)
        for prim, key in zip(prims, kinds.keys(prims), strict=True):
            keep = decided.get(key)
            if keep is None:
                keep = decided[key] = not wanted.isdisjoint(kinds.names(key))
            if keep:
                result.kept[key].append(prim)
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
    for names, prims in _fields_first(walked, facts):
        asked = [rule for rule in rules if not names.isdisjoint(rule.on)]
        always = [rule for rule in asked if rule.when is None]
        triages = _triages(asked, sums, options)
        for start in range(0, len(prims), _CHUNK):
            chunk = prims[start : start + _CHUNK]
            for prim in chunk:
                for rule in always:
                    yield rule, prim
            for triage in triages:
                for prim, chosen in zip(chunk, triage.rules_for(chunk), strict=True):
                    for rule in chosen:
                        yield rule, prim


class _Triage:
    """The rules that go by one fact, chosen once for each sum that it gives."""

    def __init__(
        self,
        sum_up: Callable[[Sequence[Any]], Iterable[Any]],
        rules: list[Rule],
        options: Options,
    ) -> None:
        self._sum_up = sum_up
        self._rules = rules
        self._options = options
        self._chosen: dict[Any, list[Rule]] = {}

    def rules_for(self, prims: Sequence[Any]) -> list[list[Rule]]:
        """The rules that each prim is handed; what can't be told here, they find out themselves."""
        try:
            sums = self._sum_up(prims)
        except Exception:
            if len(prims) == 1:
                return [self._rules]
            return [chosen for prim in prims for chosen in self.rules_for([prim])]
        known = self._chosen
        return [known[found] if found in known else self._choose(found) for found in sums]

    def _choose(self, found: Any) -> list[Rule]:
        self._chosen[found] = [rule for rule in self._rules if self._holds(rule, found)]
        return self._chosen[found]

    def _holds(self, rule: Rule, found: Any) -> bool:
        try:
            options = {**rule.options, **self._options.get(rule.code, {})}
            return not rule.when or rule.when.holds(found, **options)
        except Exception:
            return True


def _fields_first(walked: Walk, facts: Facts) -> list[tuple[frozenset[str], list[Any]]]:
    """The kept prims of each kind, with its schemas.

    What Volumes are asked needs what fields hold: so those are read many at once as well.
    """
    kinds = [(facts.kinds.names(key), prims) for key, prims in walked.kept.items()]
    return sorted(kinds, key=lambda kind: schema.FIELD not in kind[0])


def _triages(rules: Iterable[Rule], sums: Sums, options: Options) -> list[_Triage]:
    by_fact: dict[str, list[Rule]] = defaultdict(list)
    for rule in rules:
        if rule.when:
            by_fact[rule.when.fact].append(rule)
    return [_Triage(getattr(sums, fact), chosen, options) for fact, chosen in by_fact.items()]


def _batches(stage: Any) -> Iterator[list[Any]]:
    roots = [stage.Traverse(), *(Usd.PrimRange(root) for root in stage.GetPrototypes())]
    for prims in roots:
        iterator = iter(prims)
        while batch := list(islice(iterator, _BATCH)):
            yield batch
