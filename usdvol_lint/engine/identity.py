"""What is the same of one problem under several variant selections."""

from __future__ import annotations

from typing import Any, TypeAlias

from usdvol_lint.facts.usd.instances import path_in_prototype
from usdvol_lint.rule import STAGE, NotChecked, Problem, Rule

Identity: TypeAlias = tuple[str, ...]


def identity(rule: Rule, problem: Problem | NotChecked, spec: Any | None) -> Identity:
    """The identity of a problem that `spec` is to blame for.

    Messages of rules on the stage, and paths inside prototypes, change with the selection: such
    problems are identified by the blamed spec, without the message.
    """
    blamed = (spec.layer.identifier, str(spec.path)) if spec else ("", "")
    kind = (rule.code, type(problem).__name__, *blamed, problem.asset or "")
    if STAGE in rule.on:
        return kind
    prim = problem.at.GetPrim()
    where = (path_in_prototype(prim), problem.at.GetName())
    return (*kind, *where) if prim.IsInPrototype() else (*kind, *where, problem.message)
