"""Which spec of a prim or property says something: the strongest, or the one that makes it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from usdvol_lint.engine.restating import first_with, values_of
from usdvol_lint.facts.usd.calls import (
    get_prim_stack,
    get_property_stack,
    get_stage,
    get_type,
    is_pseudo_root,
)
from usdvol_lint.rule import APIS


def of_prim(prim: Any, of: Any) -> Any | None:
    if is_pseudo_root(prim):
        return get_stage(prim).GetRootLayer().pseudoRoot
    return with_metadata(prim, of) or maker(prim)


def with_metadata(prim: Any, of: Any) -> Any | None:
    """The spec that says something: TYPE, APIS, `(APIS, name)`, or other metadata.

    It is the strongest, or the first of several that say the same.
    """
    if isinstance(of, tuple):
        return _listing(of[1], _stack(prim))
    return first_with(_stack(prim), of) if of else None


def maker(prim: Any) -> Any | None:
    """The weakest spec that makes a prim what it is: with its type, or else one that defines it."""
    stack = _stack(prim)
    if len(stack) == 1:
        return stack[0]
    wanted = get_type(prim)
    if wanted:
        typed = [spec for spec in stack if spec.typeName == wanted]
    else:
        typed = [spec for spec in stack if spec.specifier.name == "SpecifierDef"]
    return (typed or stack or [None])[-1]


def _listing(api: str, stack: Iterable[Any]) -> Any | None:
    """The spec that says of an API that it is applied, or that it is not."""
    found, said = None, None
    for spec in stack:
        listed = spec.GetInfo(APIS) if spec.HasInfo(APIS) else None
        if listed is None:
            continue
        is_applied = api in listed.GetAppliedItems()
        if not (is_applied or listed.isExplicit or api in listed.deletedItems):
            continue
        if found and said != is_applied:
            break
        found, said = spec, is_applied
    return found


def _stack(prim: Any) -> list[Any]:
    stack: list[Any] = get_prim_stack(prim)
    session = get_stage(prim).GetSessionLayer() if len(stack) > 1 else None
    return [spec for spec in stack if spec.layer != session] if session else stack


def weakest(prop: Any, is_valued: bool = False) -> Any | None:
    stack = get_property_stack(prop)
    valued = list(filter(has_value, stack)) if is_valued else []
    return (valued or stack or [None])[-1]


def has_value(spec: Any) -> bool:
    return any(map(spec.HasInfo, values_of(spec)))
