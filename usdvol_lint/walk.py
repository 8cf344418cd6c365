"""One traversal of the stage: every live prim, handed to the rules that asked for its schema."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from itertools import islice
from typing import Any

from pxr import Usd

from usdvol_lint import schema
from usdvol_lint.facts.kinds import Key, Kinds
from usdvol_lint.rule import Rule

_BATCH = 256
"""Small enough that its objects are gone before the garbage collector looks at them."""
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
        for prim, key in zip(prims, _keys(prims, kinds), strict=True):
            keep = decided.get(key)
            if keep is None:
                keep = decided[key] = not wanted.isdisjoint(kinds.names(key))
            if keep:
                result.kept[key].append(prim)
    return result


def assign(walked: Walk, rules: Iterable[Rule], kinds: Kinds) -> Iterator[tuple[Rule, Any]]:
    """Each rule with each kept prim that it asked for."""
    by_key = [(kinds.names(key), prims) for key, prims in walked.kept.items()]
    for rule in rules:
        asked = frozenset(rule.on)
        for names, prims in by_key:
            if not asked.isdisjoint(names):
                for prim in prims:
                    yield rule, prim


def _keys(prims: list[Any], kinds: Kinds) -> Iterable[Key]:
    if not kinds.knows_particle_fields:
        return map(kinds.key, prims)
    # The same as Kinds.key, with both loops inside the interpreter's C code: a third of the time.
    types = map(Usd.Prim.GetTypeName, prims)
    return [
        (name, *applied)
        for name, applied in zip(types, map(Usd.Prim.GetAppliedSchemas, prims), strict=True)
    ]


def _batches(stage: Any) -> Iterator[list[Any]]:
    roots = [stage.Traverse(), *(Usd.PrimRange(root) for root in stage.GetPrototypes())]
    for prims in roots:
        iterator = iter(prims)
        while batch := list(islice(iterator, _BATCH)):
            yield batch
