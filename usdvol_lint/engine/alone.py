"""What a rule finds on a layer that is opened by itself: none that is clean so is to blame."""

from __future__ import annotations

from collections.abc import Mapping
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
        self._known: dict[tuple[str, Any], set[Any]] = {}

    def is_clean(self, rule: Rule, layer: Any, path: Any, spec: Any) -> bool:
        """Whether a rule finds nothing on a prim of a layer, where a spec makes it, or one above.

        Of what can't be looked at, nothing is known.
        """
        facts = self._opened(layer)
        prim = facts.stage.GetPrimAtPath(path) if facts else None
        if not facts or not prim or not Usd.PrimDefaultPredicate(prim):
            return False
        prim = in_prototype(prim)
        try:
            return _is_made_of(prim, spec) and prim not in self._found(rule, prim, facts)
        except Exception:  # whatever a rule raises: it is reported where the stage is checked
            return False

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

    def _found(self, rule: Rule, prim: Any, facts: Facts) -> set[Any]:
        """The prims that a rule finds something on, asked about this one, or about the stage."""
        asked = [facts.stage.GetPseudoRoot()] if STAGE in rule.on else []
        if rule.on != (STAGE,):
            asked.append(prim)
        for each in asked:
            if (rule.code, each) not in self._known:
                self._known[rule.code, each] = self._run(rule, each, facts)
        return set().union(*(self._known[rule.code, each] for each in asked))

    def _run(self, rule: Rule, prim: Any, facts: Facts) -> set[Any]:
        found = rule.check(prim, facts, **self._options.get(rule.code, {}))
        return {
            get_prim(each.at)
            for each in found
            if isinstance(each, Problem) and (each.holds is None or each.holds())
        }


def _is_made_of(prim: Any, spec: Any) -> bool:
    """Whether a spec, of a prim or a property, is of a prim or of one above it."""
    own = holder_of(spec)
    while not is_pseudo_root(prim):
        if own in get_prim_stack(prim):
            return True
        prim = get_parent(prim)
    return False
