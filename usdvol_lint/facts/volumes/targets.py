"""The targets of field relationships: their state, and the prim that is the reason for it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias

from pxr import Usd

from usdvol_lint import schema
from usdvol_lint.facts.usd.calls import (
    get_parent,
    get_path,
    get_prim_stack,
    get_stage,
    has_prefix,
    prim_at,
    prim_path,
)
from usdvol_lint.facts.usd.instances import on_stage, shown, shown_path
from usdvol_lint.facts.usd.kinds import PrimKinds
from usdvol_lint.facts.volumes.states import TargetState

MayLack: TypeAlias = Callable[[Any], bool]
"""Whether opinions about a prim may lie in a layer that does not open."""

_LIVE = Usd.PrimDefaultPredicate


class Target(NamedTuple):
    """A relationship's target after forwarding; `prim` is None if nothing is at its path.

    `blamed` is the prim that explains the state: the target itself, or an ancestor that is
    inactive, undefined or abstract.
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
        """Its path, outside of prototypes."""
        return shown_path(self.stage, self.path)

    @property
    def type_name(self) -> str:
        """The type of the prim; empty where it has none."""
        return str(self.prim.GetTypeName()) if self.prim else ""

    @property
    def reason(self) -> Any:
        """What explains the state: that prim, or the pair of it and the metadata that says so."""
        return (self.blamed, "active") if self.state is TargetState.INACTIVE else self.blamed

    @property
    def instancing(self) -> tuple[Any, str] | None:
        """What keeps a relationship from forwarding to one that its instance itself has.

        A prototype has the prims below its instances, and none of their own properties.
        """
        if not (self.prim and self.path.IsPropertyPath() and self.prim.IsPrototype()):
            return None
        instance = on_stage(self.prim)
        is_there = instance.HasRelationship(self.path.name)
        return (instance, "instanceable") if is_there else None

    @property
    def place(self) -> str:
        """Its path, and that of the prim above it that explains the state, if it is another."""
        below = "" if self.blamed_path == self.shown else f" below <{self.blamed_path}>"
        return f"<{self.shown}>{below}"

    @property
    def blamed_path(self) -> str:
        """The path of the prim that explains the state."""
        return self.shown if self.blamed is self.prim else shown(self.blamed).path


def read_target(volume: Any, path: Any, kinds: PrimKinds, may_lack: MayLack) -> Target:
    """Finds the prim at the path of a Volume's target, and the target's state."""
    stage = get_stage(volume)
    prim = prim_at(stage, prim_path(path))
    if not prim:
        ancestor = _lowest_ancestor(stage, path)
        state = _unless_uncomposed(_missing_state(ancestor), ancestor, may_lack)
        return Target(path, stage, state, None, ancestor)
    if path.IsPropertyPath():
        return Target(path, stage, TargetState.PROPERTY, prim, prim)
    schemas = kinds.names(kinds.key(prim))
    state, blamed = _prim_state(prim, schemas, volume)
    if state is TargetState.OVER or not (state is TargetState.FIELD or prim.GetTypeName()):
        state = _unless_uncomposed(state, prim, may_lack)
    return Target(path, stage, state, prim, blamed, schemas)


def mistyping(prim: Any, kinds: PrimKinds) -> Any | None:
    """The spec that first gave a prim a type that no field has; None if none gives it one.

    Stronger ones that say another such type merely did not mend it.
    """
    found = None
    for spec in get_prim_stack(prim):
        if spec.typeName and schema.FIELD in kinds.names((spec.typeName,)):
            break
        found = spec if spec.typeName else found
    return found


def _unless_uncomposed(state: TargetState, prim: Any, may_lack: MayLack) -> TargetState:
    """UNCOMPOSED for a state that opinions in a layer that does not open may change."""
    may_change = state in (TargetState.MISSING, TargetState.OVER, TargetState.NOT_A_FIELD)
    return TargetState.UNCOMPOSED if may_change and may_lack(prim) else state


def _lowest_ancestor(stage: Any, path: Any) -> Any:
    """The lowest prim that exists above a path without a prim."""
    for ancestor in path.GetPrimPath().GetAncestorsRange():
        if prim := stage.GetPrimAtPath(ancestor):
            return prim
    return stage.GetPseudoRoot()


def _missing_state(ancestor: Any) -> TargetState:
    """The state of a target that does not exist, by the lowest ancestor that does."""
    if not ancestor.IsActive():
        return TargetState.INACTIVE
    if not ancestor.IsLoaded():
        return TargetState.UNLOADED
    return TargetState.MISSING


def _prim_state(prim: Any, schemas: frozenset[str], volume: Any) -> tuple[TargetState, Any]:
    """The state of a prim, and the prim that explains it."""
    for each in (*_instances_above(prim), prim):
        if found := _off_stage(each, volume):
            return found
    return _schema_state(prim, schemas), prim


def _instances_above(prim: Any) -> list[Any]:
    """The instances that an instance proxy is in, the outermost first: it lacks their flags."""
    instances = []
    while prim.IsInstanceProxy():
        prim = get_parent(prim)
        if prim.IsInstance():
            instances.append(prim)
    return instances[::-1]


def _off_stage(prim: Any, volume: Any) -> tuple[TargetState, Any] | None:
    """Why a prim is not on the stage, and the prim that explains it."""
    if _LIVE(prim):
        return None
    if not prim.IsActive():
        return TargetState.INACTIVE, prim
    if not prim.IsLoaded():
        return TargetState.UNLOADED, prim
    if not prim.IsDefined() and not _is_drawn_with(volume, prim):
        return TargetState.OVER, _topmost(prim, lambda above: not above.IsDefined())
    if prim.IsAbstract():
        return TargetState.ABSTRACT, _topmost(prim, lambda above: above.IsAbstract())
    return None


def _is_drawn_with(volume: Any, prim: Any) -> bool:
    """Whether the same `over` hides a prim as hides a Volume that is drawn, as a prototype."""
    while prim.HasDefiningSpecifier():
        prim = get_parent(prim)
    return bool(has_prefix(get_path(volume), get_path(prim)))


def _topmost(prim: Any, is_alike: Callable[[Any], bool]) -> Any:
    """The topmost prim of the unbroken chain of ancestors that are alike, or `prim` itself."""
    while not (parent := prim.GetParent()).IsPseudoRoot() and is_alike(parent):
        prim = parent
    return prim


def _schema_state(prim: Any, schemas: frozenset[str]) -> TargetState:
    """The state of a live prim, by what it is."""
    if schema.FIELD in schemas:
        return TargetState.FIELD
    if schema.UNKNOWN_TYPE in schemas:
        return TargetState.UNKNOWN_TYPE
    if prim.GetTypeName() in schema.ABSTRACT_TYPES:
        return TargetState.ABSTRACT_TYPE
    return TargetState.NOT_A_FIELD
