"""Which spec of a prim or property says something: the strongest, or the one that makes it."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

from pxr import Sdf

from usdvol_lint.facts.usd.calls import (
    get_prim_stack,
    get_property_stack,
    get_stage,
    get_type,
    is_pseudo_root,
)
from usdvol_lint.rule import APIS, TYPE

_VALUES, _TARGETS = ("default", "timeSamples", "spline"), ("targetPaths",)


def of_prim(prim: Any, of: Any) -> Any | None:
    if is_pseudo_root(prim):
        return get_stage(prim).GetRootLayer().pseudoRoot
    return with_metadata(prim, of) or maker(prim)


def with_metadata(prim: Any, of: Any) -> Any | None:
    """The strongest spec that says something: TYPE, APIS, `(APIS, name)`, or other metadata."""
    if of == TYPE:
        return _typed(prim)
    if isinstance(of, tuple):
        return next(filter(_lists(of[1]), _stack(prim)), None)
    return saying(of, _stack(prim)) if of else None


def saying(key: str, stack: Iterable[Any]) -> Any | None:
    """The strongest spec with some metadata."""
    return next((spec for spec in stack if spec.HasInfo(key)), None)


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


def _typed(prim: Any) -> Any | None:
    """The spec whose type counts: the last of those that say the same, one after the other."""
    typed = [spec for spec in _stack(prim) if spec.typeName]
    found = None
    for spec in typed:
        if found and spec.typeName != found.typeName:
            break
        found = spec
    return found


def _lists(api: str) -> Callable[[Any], bool]:
    """Whether a spec says of an API that it is applied, or not."""

    def lists(spec: Any) -> bool:
        listed = spec.GetInfo(APIS) if spec.HasInfo(APIS) else None
        if listed is None:
            return False
        return listed.isExplicit or api in (*listed.GetAppliedItems(), *listed.deletedItems)

    return lists


def _stack(prim: Any) -> list[Any]:
    stack: list[Any] = get_prim_stack(prim)
    session = get_stage(prim).GetSessionLayer() if len(stack) > 1 else None
    return [spec for spec in stack if spec.layer != session] if session else stack


def weakest(prop: Any, is_valued: bool = False) -> Any | None:
    stack = get_property_stack(prop)
    valued = list(filter(has_value, stack)) if is_valued else []
    return (valued or stack or [None])[-1]


def has_value(spec: Any) -> bool:
    is_relationship = isinstance(spec, Sdf.RelationshipSpec)
    return any(map(spec.HasInfo, _TARGETS if is_relationship else _VALUES))
