"""What one target of a field relationship turns out to be, and which prim is to blame."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias

from pxr import Usd

from usdvol_lint import schema
from usdvol_lint.facts.usd.calls import prim_at, prim_path
from usdvol_lint.facts.usd.instances import shown, shown_path
from usdvol_lint.facts.usd.kinds import Kinds
from usdvol_lint.facts.volumes.states import TargetState

MayLack: TypeAlias = Callable[[Any], bool]
"""Whether opinions about a prim may lie in a layer that does not open."""

_LIVE = Usd.PrimDefaultPredicate


class Target(NamedTuple):
    """One forwarded target, which `prim` is None for where there is none.

    `blamed` is the target itself or, where that is why it is not live, the prim above it.
    `schemas` are those that the prim answers to.
    """

    path: Any
    stage: Any
    state: TargetState
    prim: Any | None
    blamed: Any
    schemas: frozenset[str] = frozenset()

    @property
    def shown(self) -> str:
        """Its path as the stage shows it."""
        return shown_path(self.stage, self.path)

    @property
    def type_name(self) -> str:
        """The type of the prim; empty where it has none."""
        return str(self.prim.GetTypeName()) if self.prim else ""

    @property
    def blamed_path(self) -> str:
        """The path of the prim to blame."""
        return self.shown if self.blamed is self.prim else shown(self.blamed).path


def read_target(stage: Any, path: Any, kinds: Kinds, may_lack: MayLack) -> Target:
    """Looks up the prim at the path of a target, and decides the target's state."""
    prim = prim_at(stage, prim_path(path))
    if not prim:
        nearest = _nearest_prim(stage, path)
        state = _told(_missing_state(nearest), nearest, may_lack)
        return Target(path, stage, state, None, nearest)
    if path.IsPropertyPath():
        return Target(path, stage, TargetState.PROPERTY, prim, prim)
    schemas = kinds.names(kinds.key(prim))
    state, culprit = _prim_state(prim, schemas)
    if state is TargetState.OVER or not (state is TargetState.FIELD or prim.GetTypeName()):
        state = _told(state, prim, may_lack)
    return Target(path, stage, state, prim, culprit, schemas)


def _told(state: TargetState, nearest: Any, may_lack: MayLack) -> TargetState:
    """The state of what lacks something, unless a layer that does not open may have it."""
    vague = state in (TargetState.MISSING, TargetState.OVER, TargetState.NOT_A_FIELD)
    return TargetState.UNCOMPOSED if vague and may_lack(nearest) else state


def _nearest_prim(stage: Any, path: Any) -> Any:
    """The lowest prim on the way to where there is none."""
    for ancestor in path.GetPrimPath().GetAncestorsRange():
        if prim := stage.GetPrimAtPath(ancestor):
            return prim
    return stage.GetPseudoRoot()


def _missing_state(nearest: Any) -> TargetState:
    """The state of a target that does not exist."""
    if not nearest.IsActive():
        return TargetState.INACTIVE
    if not nearest.IsLoaded():
        return TargetState.UNLOADED
    return TargetState.MISSING


def _prim_state(prim: Any, schemas: frozenset[str]) -> tuple[TargetState, Any]:
    """The state of a prim, and the prim to blame for it."""
    if _LIVE(prim):
        return _kind_state(prim, schemas), prim
    if not prim.IsActive():
        return TargetState.INACTIVE, prim
    if not prim.IsLoaded():
        return TargetState.UNLOADED, prim
    if not prim.IsDefined():
        return TargetState.OVER, _topmost(prim, lambda above: not above.IsDefined())
    if prim.IsAbstract():
        return TargetState.ABSTRACT, _topmost(prim, lambda above: above.IsAbstract())
    return _kind_state(prim, schemas), prim


def _topmost(prim: Any, has_trait: Callable[[Any], bool]) -> Any:
    """The topmost of the prims from `prim` upward that have what it inherits from above."""
    while not (parent := prim.GetParent()).IsPseudoRoot() and has_trait(parent):
        prim = parent
    return prim


def _kind_state(prim: Any, schemas: frozenset[str]) -> TargetState:
    if schema.FIELD in schemas:
        return TargetState.FIELD
    if schema.UNKNOWN_TYPE in schemas:
        return TargetState.UNKNOWN_TYPE
    if prim.GetTypeName() in schema.ABSTRACT_TYPES:
        return TargetState.ABSTRACT_TYPE
    return TargetState.NOT_A_FIELD
