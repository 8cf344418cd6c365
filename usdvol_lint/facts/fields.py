"""What a Volume's `field:` namespace really binds, and what only looks as if it did."""

from __future__ import annotations

import builtins
from bisect import bisect
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from pxr import Usd

from usdvol_lint import schema
from usdvol_lint.facts.instances import in_prototype, shown, shown_path
from usdvol_lint.facts.kinds import Kinds
from usdvol_lint.facts.states import Emptiness, TargetState
from usdvol_lint.nearest import nearest_word

NAMESPACE = "field"


@dataclass(frozen=True, slots=True)
class Target:
    """One forwarded target, which `prim` is None for where there is none.

    `shown` is its path as the stage shows it, `culprit` that of the prim to blame: the target
    itself or, where that is why it is not live, the prim above it.
    """

    path: Any
    shown: str
    state: TargetState
    prim: Any | None = None
    culprit: str = ""


@dataclass(frozen=True, slots=True)
class Binding:
    """One property of the `field:` namespace.

    `name` is what follows `field:`; USD keys the field by `key`, the last part of it.
    `emptiness` is None where there are targets; `lost` are specs whose targets did not survive
    composition, strongest first; `forwards_to` is the relationship that one without targets
    forwards to.
    """

    property: Any
    name: str
    is_relationship: bool
    targets: tuple[Target, ...] = ()
    emptiness: Emptiness | None = None
    lost: tuple[Any, ...] = ()
    forwards_to: str = ""

    @builtins.property
    def key(self) -> str:
        return self.name.rpartition(":")[2]

    @builtins.property
    def target(self) -> Target | None:
        """The target if there is exactly one: USD drops the relationship if there are several."""
        return self.targets[0] if len(self.targets) == 1 else None

    @builtins.property
    def is_bound(self) -> bool:
        """Whether USD and renderers get a field from it."""
        return self.target is not None and self.target.state is TargetState.FIELD


@dataclass(frozen=True, slots=True)
class FieldBindings:
    """The bindings of one Volume, by name.

    `strays` are relationships outside the namespace that a reader would take for fields: a bare
    `rel field`, or any other, unless a schema declares it, that targets a field prim which no
    relationship in the namespace does.
    """

    bindings: tuple[Binding, ...]
    strays: tuple[Any, ...]

    @property
    def relationships(self) -> tuple[Binding, ...]:
        return tuple(binding for binding in self.bindings if binding.is_relationship)

    def with_target(self, *states: TargetState) -> Iterator[tuple[Binding, Target]]:
        """The bindings whose one target is in one of these states, with that target."""
        for binding in self.bindings:
            if binding.target and binding.target.state in states:
                yield binding, binding.target

    def outside(self, volume: Any) -> Iterator[tuple[Binding, Target]]:
        """The bindings of fields that do not lie below the Volume, with those fields."""
        for binding, target in self.with_target(TargetState.FIELD):
            if not target.path.HasPrefix(volume.GetPath()):
                yield binding, target

    @property
    def is_sound(self) -> bool:
        """Whether there are fields and each is bound."""
        return bool(self.bindings) and all(binding.is_bound for binding in self.bindings)


def read_field_bindings(
    volume: Any, kinds: Kinds, may_lack: Callable[[Any], bool]
) -> FieldBindings:
    """Reads the authored properties of a Volume.

    `may_lack` is asked whether opinions about a prim may lie in a layer that does not open.
    """
    bindings, others = [], []
    for prop in volume.GetAuthoredProperties():
        name = prop.GetName()
        if name.startswith(f"{NAMESPACE}:"):
            bindings.append(_read_binding(prop, name, kinds, may_lack))
        elif isinstance(prop, Usd.Relationship):
            others.append(prop)
    return FieldBindings(tuple(bindings), tuple(_strays(others, bindings, kinds)))


def field_paths(bindings: FieldBindings) -> set[Any]:
    """The paths of every prim that a relationship of the Volume targets, as the walk met them."""
    prims = [target.prim for binding in bindings.bindings for target in binding.targets]
    for stray in bindings.strays:
        stage = stray.GetStage()
        prims += [stage.GetPrimAtPath(path.GetPrimPath()) for path in stray.GetForwardedTargets()]
    return {in_prototype(prim).GetPath() for prim in prims if prim}


def fields_below(volume: Any, kinds: Kinds) -> list[Any]:
    """The field prims below a Volume, those inside instances too."""
    below = Usd.PrimRange(volume, Usd.TraverseInstanceProxies())
    return [prim for prim in below if kinds.is_a(prim, schema.FIELD)]


class FieldNames:
    """Finds the field prim that a path was probably meant for."""

    def __init__(self, fields: Iterable[Any]) -> None:
        self._by_name: dict[str, list[Any]] = defaultdict(list)
        self._by_parent: dict[Any, dict[str, Any]] = defaultdict(dict)
        for path in sorted(field.GetPath() for field in fields):
            self._by_name[path.name].append(path)
            self._by_parent[path.GetParentPath()][path.name] = path

    def nearest(self, path: Any) -> Any | None:
        """A sibling of nearly the same name, or the closest field of exactly that name.

        None where two are equally close: a guess would send people the wrong way.
        """
        siblings = self._by_parent.get(path.GetParentPath(), {})
        sibling = nearest_word(path.name, siblings, cutoff=0.7, fold=str)
        if sibling:
            return siblings[sibling]
        namesakes = self._by_name.get(path.name, [])
        place = bisect(namesakes, path)  # in sorted order, the closest are next to it
        shared = defaultdict(list)
        for other in namesakes[max(place - 2, 0) : place + 2]:
            shared[path.GetCommonPrefix(other).pathElementCount].append(other)
        closest = shared[max(shared)] if shared else []
        return closest[0] if len(closest) == 1 else None


def meant_path(binding: Binding) -> Any | None:
    """Where one would look for the field of a binding that has none; None if it names a prim."""
    if not binding.targets:
        return binding.property.GetPrim().GetPath().AppendChild(binding.key)
    if binding.target and binding.target.state in (TargetState.MISSING, TargetState.PROPERTY):
        return binding.target.path.GetPrimPath()
    if binding.target and binding.target.state is TargetState.NOT_A_FIELD:
        return binding.target.path.AppendChild(binding.key)
    return None


def _read_binding(prop: Any, name: str, kinds: Kinds, may_lack: Callable[[Any], bool]) -> Binding:
    short = name[len(NAMESPACE) + 1 :]
    if not isinstance(prop, Usd.Relationship):
        return Binding(prop, short, False)
    stage = prop.GetStage()
    paths = prop.GetForwardedTargets()
    if paths:
        targets = tuple(_read_target(stage, path, kinds, may_lack) for path in paths)
        return Binding(prop, short, True, targets)
    emptiness, lost = _why_empty(prop)
    forwards_to = "".join(shown_path(stage, path) for path in prop.GetTargets()[:1])
    return Binding(prop, short, True, (), emptiness, lost, forwards_to)


def _strays(
    relationships: Iterable[Any], bindings: Iterable[Binding], kinds: Kinds
) -> Iterator[Any]:
    bound = {target.path for binding in bindings for target in binding.targets}
    for relationship in relationships:
        if relationship.GetName() == NAMESPACE or (
            not _is_declared(relationship)
            and any(
                path not in bound and kinds.is_a(prim, schema.FIELD)
                for path in relationship.GetForwardedTargets()
                if path.IsPrimPath() and (prim := relationship.GetStage().GetPrimAtPath(path))
            )
        ):
            yield relationship


def _is_declared(relationship: Any) -> bool:
    """Whether a schema declares it, as CollectionAPI does `collection:…:includes`."""
    definition = relationship.GetPrim().GetPrimDefinition()
    return relationship.GetName() in definition.GetPropertyNames()


def _why_empty(relationship: Any) -> tuple[Emptiness, tuple[Any, ...]]:
    """Reads the list ops of the specs, strongest first, for what composition left out."""
    seen = set()
    while targets := relationship.GetTargets():
        # It forwards to another relationship, and that one is empty: its emptiness counts.
        seen.add(relationship.GetPath())
        relationship = relationship.GetStage().GetRelationshipAtPath(targets[0])
        if not relationship or relationship.GetPath() in seen:
            return Emptiness.UNAUTHORED, ()
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


def _read_target(stage: Any, path: Any, kinds: Kinds, may_lack: Callable[[Any], bool]) -> Target:
    prim = stage.GetPrimAtPath(path.GetPrimPath())
    # Most targets are prims outside prototypes, and the general way takes longer.
    where = shown_path(stage, path) if not prim or prim.IsInPrototype() else str(path)
    if prim and path.IsPropertyPath():
        return Target(path, where, TargetState.PROPERTY, prim)
    nearest = prim or _nearest_prim(stage, path)
    state, culprit = _prim_state(prim, kinds) if prim else (_missing_state(nearest), nearest)
    vague = state in (TargetState.MISSING, TargetState.OVER) or (
        state is TargetState.NOT_A_FIELD and not prim.GetTypeName()
    )
    if vague and may_lack(nearest):
        state = TargetState.UNCOMPOSED
    to_blame = where if culprit is prim else shown(culprit).path
    return Target(path, where, state, prim or None, to_blame)


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


def _prim_state(prim: Any, kinds: Kinds) -> tuple[TargetState, Any]:
    """The state of a prim, and the prim to blame for it."""
    if not prim.IsActive():
        return TargetState.INACTIVE, prim
    if not prim.IsLoaded():
        return TargetState.UNLOADED, prim
    if not prim.IsDefined():
        return TargetState.OVER, _topmost(prim, lambda above: not above.IsDefined())
    if prim.IsAbstract():
        return TargetState.ABSTRACT, _topmost(prim, lambda above: above.IsAbstract())
    return _kind_state(prim, kinds), prim


def _topmost(prim: Any, has_trait: Callable[[Any], bool]) -> Any:
    """The topmost of the prims from `prim` upward that have what it inherits from above."""
    while not (parent := prim.GetParent()).IsPseudoRoot() and has_trait(parent):
        prim = parent
    return prim


def _kind_state(prim: Any, kinds: Kinds) -> TargetState:
    names = kinds.names(kinds.key(prim))
    if schema.FIELD in names:
        return TargetState.FIELD
    if schema.UNKNOWN_TYPE in names:
        return TargetState.UNKNOWN_TYPE
    if prim.GetTypeName() in schema.ABSTRACT_TYPES:
        return TargetState.ABSTRACT_TYPE
    return TargetState.NOT_A_FIELD
