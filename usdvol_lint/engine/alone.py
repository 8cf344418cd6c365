"""What a rule finds on a layer that is opened by itself: none that is clean so is to blame."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from itertools import chain
from typing import Any

from pxr import Usd

from usdvol_lint.engine.walk import walk
from usdvol_lint.facts import Context, Facts
from usdvol_lint.facts.usd.calls import (
    get_parent,
    get_prim,
    get_prim_stack,
    holder_of,
    is_pseudo_root,
)
from usdvol_lint.facts.usd.diagnostics import UNREADABLE
from usdvol_lint.facts.usd.instances import in_prototype
from usdvol_lint.rule import STAGE, Problem, Rule


class Alone:
    """The layers below one stage, each opened by itself at most once.

    `context` is that of the stage, `asked_for` the schemas of the prims that rules ask for, and
    `options` those of the rules, by code.
    """

    def __init__(
        self, context: Context, asked_for: frozenset[str], options: Mapping[str, Mapping[str, Any]]
    ) -> None:
        self._context = context
        self._asked_for = asked_for
        self._options = options
        self._facts: dict[Any, Facts | None] = {}
        self._known: dict[tuple[str, Any], list[Problem]] = {}

    def is_clean(self, rule: Rule, layer: Any, path: Any, spec: Any) -> bool:
        """Whether a rule finds nothing on a prim of a layer that has a spec, of it or another.

        Of what can't be looked at, nothing is known.
        """
        facts = self._opened(layer)
        prim = self._prim_at(facts, path)
        if not facts or prim is None:
            return False
        try:
            is_there = _is_made_of(prim, spec) or _is_in(facts.stage, spec)
            return is_there and not self._found(rule, prim, facts)
        except Exception:  # whatever a rule raises: it is reported where the stage is checked
            return False

    def alike(self, rule: Rule, layer: Any, path: Any, problem: Problem) -> Problem | None:
        """What a rule finds on a prim of a layer that is like a problem found on the stage."""
        facts = self._opened(layer)
        prim = self._prim_at(facts, path)
        if not facts or prim is None:
            return None
        try:
            found = self._found(rule, prim, facts)
        except Exception:  # the same
            return None
        return next((each for each in found if _key(each) == _key(problem)), None)

    def sleeps(self, layer: Any, path: Any) -> bool:
        """Whether a prim of a layer, or one above it, is inactive, so that no rule looks at it."""
        facts = self._opened(layer)
        if not facts:
            return False
        while not (prim := facts.stage.GetPrimAtPath(path)):
            path = path.GetParentPath()
        return not prim.IsActive()

    def _prim_at(self, facts: Facts | None, path: Any) -> Any | None:
        """The drawn prim at a path, or the one in a prototype that it shows."""
        prim = facts.stage.GetPrimAtPath(path) if facts else None
        return in_prototype(prim) if prim and Usd.PrimDefaultPredicate(prim) else None

    def _opened(self, layer: Any) -> Facts | None:
        if layer not in self._facts:
            try:
                loads_none = self._context.depth.load == "none"
                policy = Usd.Stage.LoadNone if loads_none else Usd.Stage.LoadAll
                self._facts[layer] = self._facts_of(Usd.Stage.Open(layer, policy))
            except UNREADABLE:
                self._facts[layer] = None
        return self._facts[layer]

    def _facts_of(self, stage: Any) -> Facts:
        given = self._context
        context = Context.of(stage, given.depth, telling=given.telling)
        return Facts(context, walk(stage, self._asked_for, context.kinds))

    def _found(self, rule: Rule, prim: Any, facts: Facts) -> list[Problem]:
        """What a rule finds on a prim, asked about this one, or about the stage."""
        asked = [facts.stage.GetPseudoRoot()] if STAGE in rule.on else []
        asked += _asked_about(rule, prim, facts)
        for each in asked:
            if (rule.code, each) not in self._known:
                self._known[rule.code, each] = self._run(rule, each, facts)
        found = chain.from_iterable(self._known[rule.code, each] for each in asked)
        return [each for each in found if get_prim(each.at) == prim]

    def _run(self, rule: Rule, prim: Any, facts: Facts) -> list[Problem]:
        found = rule.check(prim, facts, **self._options.get(rule.code, {}))
        return [
            each
            for each in found
            if isinstance(each, Problem) and (each.holds is None or each.holds())
        ]


def _asked_about(rule: Rule, prim: Any, facts: Facts) -> Iterable[Any]:
    """The prim, or the next one above it that a rule is handed and may find something below.

    Where there is none, what it finds there, such as a name that is inherited, it finds for others.
    """
    while not is_pseudo_root(prim):
        if not facts.kinds.names(facts.kinds.key(prim)).isdisjoint(rule.on):
            return [prim]
        prim = get_parent(prim)
    return chain.from_iterable(map(facts.tables.prims, rule.on))


def _key(problem: Problem) -> tuple[str, str]:
    """What a problem of a rule is about, on one prim."""
    return problem.at.GetName() if isinstance(problem.at, Usd.Property) else "", problem.subject


def _is_in(stage: Any, spec: Any) -> bool:
    """Whether a spec, of a prim or a property, is of the prim at its own path of a stage."""
    own = holder_of(spec)
    prim = stage.GetPrimAtPath(own.path.StripAllVariantSelections())
    return bool(prim) and own in get_prim_stack(prim)


def _is_made_of(prim: Any, spec: Any) -> bool:
    """Whether a spec, of a prim or a property, is of a prim or of one above it."""
    own = holder_of(spec)
    while not is_pseudo_root(prim):
        if own in get_prim_stack(prim):
            return True
        prim = get_parent(prim)
    return False
