"""What a Volume's `field:` namespace really binds, and what only looks as if it did."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from pxr import Sdf, Usd

from usdvol_lint import schema
from usdvol_lint.facts.instances import in_prototype
from usdvol_lint.facts.kinds import Kinds
from usdvol_lint.facts.states import Emptiness, TargetState

NAMESPACE = "field"


@dataclass(frozen=True, slots=True)
class Target:
    """One forwarded target: `prim` is None where there is none, `culprit` is the prim to blame."""

    path: Any
    state: TargetState
    prim: Any | None = None
    culprit: Any | None = None


@dataclass(frozen=True, slots=True)
class Binding:
    """One property of the `field:` namespace.

    `name` is what follows `field:`; USD keys the field by `key`, the last part of it.
    `emptiness` is None where there are targets; `lost` are specs whose targets did not survive
    composition, strongest first.
    """

    property: Any
    name: str
    is_relationship: bool
    targets: tuple[Target, ...] = ()
    emptiness: Emptiness | None = None
    lost: tuple[Any, ...] = ()

    @property
    def key(self) -> str:
        return self.name.rpartition(":")[2]


@dataclass(frozen=True, slots=True)
class FieldBindings:
    """The bindings of one Volume, by name.

    `strays` are relationships outside the namespace that a reader would take for fields: a bare
    `rel field`, or any other that targets a field prim.
    """

    bindings: tuple[Binding, ...]
    strays: tuple[Any, ...]

    @property
    def relationships(self) -> tuple[Binding, ...]:
        return tuple(binding for binding in self.bindings if binding.is_relationship)


def read_field_bindings(volume: Any, kinds: Kinds) -> FieldBindings:
    """Reads the authored properties of a Volume."""
    bindings, strays = [], []
    for prop in volume.GetAuthoredProperties():
        name = prop.GetName()
        is_relationship = isinstance(prop, Usd.Relationship)
        if name.startswith(f"{NAMESPACE}:"):
            bindings.append(_read_binding(prop, name, is_relationship, kinds))
        elif name == NAMESPACE or (is_relationship and _targets_a_field(prop, kinds)):
            strays.append(prop)
    return FieldBindings(tuple(bindings), tuple(strays))


def field_paths(volume: Any, bindings: FieldBindings) -> set[Any]:
    """The paths of every prim that a relationship of the Volume targets, as the walk met them."""
    targets = {
        target
        for relationship in [*(b.property for b in bindings.relationships), *bindings.strays]
        if isinstance(relationship, Usd.Relationship)
        for target in relationship.GetForwardedTargets()
    }
    stage = volume.GetStage()
    prims = (stage.GetPrimAtPath(target.GetPrimPath()) for target in targets)
    return {in_prototype(prim).GetPath() for prim in prims if prim}


def _read_binding(prop: Any, name: str, is_relationship: bool, kinds: Kinds) -> Binding:
    short = name[len(NAMESPACE) + 1 :]
    if not is_relationship:
        return Binding(prop, short, False)
    paths = prop.GetForwardedTargets()
    if paths:
        targets = tuple(_read_target(prop.GetStage(), path, kinds) for path in paths)
        return Binding(prop, short, True, targets)
    emptiness, lost = _why_empty(prop)
    return Binding(prop, short, True, (), emptiness, lost)


def _why_empty(relationship: Any) -> tuple[Emptiness, tuple[Any, ...]]:
    """Reads the list ops of the specs, weakest first, as composition would apply them."""
    if relationship.GetTargets():
        # It forwards to another relationship, and that one is empty: its own emptiness counts.
        forwarded = relationship.GetStage().GetObjectAtPath(relationship.GetTargets()[0])
        return _why_empty(forwarded) if forwarded else (Emptiness.UNAUTHORED, ())
    lost: list[Any] = []
    emptiness = Emptiness.UNAUTHORED
    deleted: set[str] = set()
    for spec in relationship.GetPropertyStack():
        targets = spec.targetPathList
        deleted.update(path.name for path in targets.deletedItems)
        held = [path for path in targets.GetAddedOrExplicitItems() if path.name not in deleted]
        if held:
            lost.append(spec)
        elif targets.GetAddedOrExplicitItems():
            emptiness = Emptiness.DELETED
        if targets.isExplicit:
            if not held and not lost and emptiness is Emptiness.UNAUTHORED:
                emptiness = Emptiness.BLOCKED
            break
    return (Emptiness.LOST, tuple(lost)) if lost else (emptiness, ())


def _read_target(stage: Any, path: Any, kinds: Kinds) -> Target:
    prim = stage.GetPrimAtPath(path.GetPrimPath())
    if not prim:
        return _missing_target(stage, path)
    if path.IsPropertyPath():
        return Target(path, TargetState.PROPERTY, prim)
    return Target(path, _prim_state(prim, kinds), prim, prim)


def _missing_target(stage: Any, path: Any) -> Target:
    ancestor_path = path.GetPrimPath()
    while not stage.GetPrimAtPath(ancestor_path):
        ancestor_path = ancestor_path.GetParentPath()
    ancestor = stage.GetPrimAtPath(ancestor_path)
    if not ancestor.IsActive():
        return Target(path, TargetState.INACTIVE, None, ancestor)
    if not ancestor.IsLoaded():
        return Target(path, TargetState.UNLOADED, None, ancestor)
    return Target(path, TargetState.MISSING, None, ancestor)


def _prim_state(prim: Any, kinds: Kinds) -> TargetState:
    if not prim.IsActive():
        return TargetState.INACTIVE
    if not prim.IsLoaded():
        return TargetState.UNLOADED
    if not prim.IsDefined():
        return TargetState.OVER
    if prim.IsAbstract():
        return TargetState.ABSTRACT
    names = kinds.names(kinds.key(prim))
    if schema.FIELD in names:
        return TargetState.FIELD
    if schema.UNKNOWN_TYPE in names:
        return TargetState.UNKNOWN_TYPE
    if prim.GetTypeName() in schema.ABSTRACT_TYPES:
        return TargetState.ABSTRACT_TYPE
    return TargetState.NOT_A_FIELD


def _targets_a_field(relationship: Any, kinds: Kinds) -> bool:
    stage = relationship.GetStage()
    targets = (path for path in relationship.GetTargets() if Sdf.Path(path).IsPrimPath())
    prims = (stage.GetPrimAtPath(path) for path in targets)
    return any(prim and kinds.is_a(prim, schema.FIELD) for prim in prims)
