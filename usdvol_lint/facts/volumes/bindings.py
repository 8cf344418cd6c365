"""What a Volume's `field:` namespace really binds, and what only looks as if it did."""

from __future__ import annotations

import builtins
from bisect import bisect
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from enum import Enum
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

from pxr import Sdf, Usd

from usdvol_lint import schema
from usdvol_lint.facts.prims.attributes import Authored
from usdvol_lint.facts.usd.batches import PrimBatch
from usdvol_lint.facts.usd.calls import (
    get_name,
    get_path,
    get_properties,
    get_stage,
    get_targets,
    has_prefix,
    parent_path,
    prim_at,
    prim_path,
)
from usdvol_lint.facts.usd.instances import in_prototype, shown, shown_path
from usdvol_lint.facts.usd.kinds import PrimKinds
from usdvol_lint.facts.volumes.states import BindingMark, Emptiness, TargetState
from usdvol_lint.nearest import closest_match

if TYPE_CHECKING:
    from usdvol_lint.facts.prims.tables import Slot

_BARE_NAMESPACE = schema.FIELD_NAMESPACE.rstrip(":")
_LIVE = Usd.PrimDefaultPredicate


MayLack: TypeAlias = Callable[[Any], bool]


class Target(NamedTuple):
    """One forwarded target, which `prim` is None for where there is none.

    `to_blame` is the target itself or, where that is why it is not live, the prim above it.
    `schemas` are those that the prim answers to.
    """

    path: Any
    stage: Any
    state: TargetState
    prim: Any | None
    to_blame: Any
    schemas: frozenset[str] = frozenset()

    @builtins.property
    def shown(self) -> str:
        """Its path as the stage shows it."""
        return shown_path(self.stage, self.path)

    @builtins.property
    def type_name(self) -> str:
        """The type of the prim; empty where it has none."""
        return str(self.prim.GetTypeName()) if self.prim else ""

    @builtins.property
    def culprit(self) -> str:
        """The path of the prim to blame."""
        return self.shown if self.to_blame is self.prim else shown(self.to_blame).path


class Binding(NamedTuple):
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


class FieldBindings(NamedTuple):
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

    def with_files(self) -> Iterator[tuple[Binding, Target]]:
        """The bindings of fields that name files, with those fields."""
        for binding, target in self.with_target(TargetState.FIELD):
            if schema.FIELD_ASSET in target.schemas:
                yield binding, target

    def outside(self, volume: Any) -> Iterator[tuple[Binding, Target]]:
        """The bindings of fields that do not lie below the Volume, with those fields."""
        for binding, target in self.with_target(TargetState.FIELD):
            if not target.path.HasPrefix(volume.GetPath()):
                yield binding, target

    def marks(self, volume: Any) -> frozenset[Enum]:
        """What there is to say of the bindings of a Volume, if there is anything."""
        found: set[Enum] = set()
        for _, name, is_relationship, targets, emptiness, *_ in self.bindings:
            if emptiness:
                found.add(emptiness)
            elif not is_relationship:
                found.add(BindingMark.ATTRIBUTE)
            elif len(targets) > 1:
                found.add(BindingMark.SEVERAL_TARGETS)
            else:
                found.add(targets[0].state)
                if not has_prefix(targets[0].path, get_path(volume)):
                    found.add(BindingMark.OUTSIDE)
            if ":" in name:
                found.add(BindingMark.NESTED)
        if len(self.bindings) != 1:
            found.add(BindingMark.SEVERAL if self.bindings else BindingMark.NONE)
        if self.strays:
            found.add(BindingMark.STRAY)
        return frozenset(found)

    @property
    def is_sound(self) -> bool:
        """Whether there are fields and each is bound."""
        return bool(self.bindings) and all(binding.is_bound for binding in self.bindings)


class Bound(NamedTuple):
    """What there is to know of the bindings of a Volume that have no faults.

    `marks` say what is remarkable about them, `fields` are the places of the live fields that they
    target.  `looked_at` are the bindings themselves where they had to be looked at: elsewhere each
    is one of these fields, right below the Volume.
    """

    marks: frozenset[Enum]
    fields: tuple[Slot, ...]
    looked_at: FieldBindings | None = None


class BindingReader:
    """Reads what Volumes bind.

    `may_lack` is asked whether opinions about a prim may lie in a layer that does not open.
    """

    def __init__(self, kinds: PrimKinds) -> None:
        self._kinds = kinds

    def read_many(
        self, batch: PrimBatch, authored: Authored, live: Mapping[Any, Slot], may_lack: MayLack
    ) -> list[Bound]:
        """What many Volumes bind that are alike; `live` are the places of live fields, by path.

        Bindings are looked at one by one only where they are not plain.
        """
        marks: set[Enum] = {TargetState.FIELD}
        if len(authored.bound) > 1:
            marks.add(BindingMark.SEVERAL)
        if any(name.count(":") > 1 for name in authored.bound):
            marks.add(BindingMark.NESTED)
        plain = frozenset(marks)
        columns = [_below(batch.relationships(name), batch.paths, live) for name in authored.bound]
        fields = list(zip(*columns, strict=True)) if columns else [(None,)] * len(batch.prims)
        if len(columns) > 1:  # two relationships may target one field
            fields = [tuple(dict.fromkeys(own)) for own in fields]
        for name in authored.undeclared:
            for row, relationship in enumerate(batch.relationships(name)):
                if relationship:
                    fields[row] = (None,)
        return [
            self._look(volume, live, may_lack) if None in own else Bound(plain, own)
            for volume, own in zip(batch.prims, fields, strict=True)
        ]

    def _look(self, volume: Any, live: Mapping[Any, Slot], may_lack: MayLack) -> Bound:
        bindings = self.read(volume, may_lack)
        paths = field_paths(bindings)
        places = tuple(live[path] for path in sorted(paths) if path in live)
        return Bound(bindings.marks(volume), places, bindings)

    def read(self, volume: Any, may_lack: MayLack) -> FieldBindings:
        """What the authored properties of a Volume bind."""
        bindings, others = [], []
        for prop in get_properties(volume):
            name = get_name(prop)
            if name.startswith(schema.FIELD_NAMESPACE):
                bindings.append(self._binding(prop, name[len(schema.FIELD_NAMESPACE) :], may_lack))
            elif isinstance(prop, Usd.Relationship):
                others.append(prop)
        strays = tuple(_strays(others, bindings, self._kinds)) if others else ()
        return FieldBindings(tuple(bindings), strays)

    def _binding(self, prop: Any, name: str, may_lack: MayLack) -> Binding:
        if not isinstance(prop, Usd.Relationship):
            return Binding(prop, name, False)
        stage = get_stage(prop)
        paths = get_targets(prop)
        if paths:
            targets = tuple([self._target(stage, path, may_lack) for path in paths])
            return Binding(prop, name, True, targets)
        emptiness, lost = _why_empty(prop)
        forwards_to = "".join(shown_path(stage, path) for path in prop.GetTargets()[:1])
        return Binding(prop, name, True, (), emptiness, lost, forwards_to)

    def _target(self, stage: Any, path: Any, may_lack: MayLack) -> Target:
        prim = prim_at(stage, prim_path(path))
        if not prim:
            nearest = _nearest_prim(stage, path)
            state = _told(_missing_state(nearest), nearest, may_lack)
            return Target(path, stage, state, None, nearest)
        if path.IsPropertyPath():
            return Target(path, stage, TargetState.PROPERTY, prim, prim)
        schemas = self._kinds.names(self._kinds.key(prim))
        state, culprit = _prim_state(prim, schemas)
        if state is TargetState.OVER or not (state is TargetState.FIELD or prim.GetTypeName()):
            state = _told(state, prim, may_lack)
        return Target(path, stage, state, prim, culprit, schemas)


def _below(
    relationships: Iterable[Any], volumes: Iterable[Any], live: Mapping[Any, Slot]
) -> list[Slot | None]:
    """The places of single targets that are live fields right below their Volumes."""
    found: list[Slot | None] = []
    for relationship, volume in zip(relationships, volumes, strict=True):
        paths: Sequence[Any] = get_targets(relationship) if relationship else ()
        is_below = len(paths) == 1 and parent_path(paths[0]) == volume
        found.append(live.get(paths[0]) if is_below else None)
    return found


def _told(state: TargetState, nearest: Any, may_lack: MayLack) -> TargetState:
    """The state of what lacks something, unless a layer that does not open may have it."""
    vague = state in (TargetState.MISSING, TargetState.OVER, TargetState.NOT_A_FIELD)
    return TargetState.UNCOMPOSED if vague and may_lack(nearest) else state


def field_paths(bindings: FieldBindings) -> set[Any]:
    """The paths of every prim that a relationship of the Volume targets, as the walk met them."""
    prims = [target.prim for binding in bindings.bindings for target in binding.targets]
    for stray in bindings.strays:
        stage = stray.GetStage()
        prims += [stage.GetPrimAtPath(path.GetPrimPath()) for path in stray.GetForwardedTargets()]
    return {in_prototype(prim).GetPath() for prim in prims if prim}


def fields_below(volume: Any, kinds: PrimKinds) -> list[Any]:
    """The field prims below a Volume, those inside instances too."""
    below = Usd.PrimRange(volume, Usd.TraverseInstanceProxies())
    return [prim for prim in below if kinds.is_a(prim, schema.FIELD)]


class FieldNames:
    """Finds the field prim that a path was probably meant for."""

    def __init__(self, fields: Iterable[Any], volumes: Iterable[Any]) -> None:
        self._volumes = frozenset(volume.GetPath() for volume in volumes)
        self._by_name: dict[str, list[Any]] = defaultdict(list)
        self._by_parent: dict[Any, dict[str, Any]] = defaultdict(dict)
        for path in sorted(field.GetPath() for field in fields):
            self._by_name[path.name].append(path)
            self._by_parent[path.GetParentPath()][path.name] = path

    def meant_by(self, binding: Binding) -> Any | None:
        """The path of the field that a binding of none was probably meant to target."""
        path = _meant_path(binding)
        return self.nearest(path, binding.property.GetPrim().GetPath()) if path else None

    def nearest(self, path: Any, volume: Any) -> Any | None:
        """A sibling of nearly the same name, or the closest field of exactly that name.

        None where two are equally close: a guess would send people the wrong way; and no field of
        that name below another Volume than that at the path `volume`.
        """
        siblings = self._by_parent.get(path.GetParentPath(), {})
        sibling = closest_match(path.name, siblings, cutoff=0.7, fold=str)
        if sibling:
            return siblings[sibling]
        namesakes = self._by_name.get(path.name, [])
        place = bisect(namesakes, path)  # in sorted order, the closest are next to it
        shared = defaultdict(list)
        for other in namesakes[max(place - 2, 0) : place + 2]:
            shared[path.GetCommonPrefix(other).pathElementCount].append(other)
        closest = shared[max(shared)] if shared else []
        if len(closest) != 1:
            return None
        above = {volume, *closest[0].GetPrefixes()} & self._volumes
        return closest[0] if above <= {volume} else None


def _meant_path(binding: Binding) -> Any | None:
    """Where one would look for the field of a binding that has none; None if it names a prim."""
    if not binding.targets:
        return binding.property.GetPrim().GetPath().AppendChild(binding.key)
    if binding.target and binding.target.state in (TargetState.MISSING, TargetState.PROPERTY):
        return binding.target.path.GetPrimPath()
    if binding.target and binding.target.state is TargetState.NOT_A_FIELD:
        return binding.target.path.AppendChild(binding.key)
    return None


def _strays(
    relationships: Iterable[Any], bindings: Iterable[Binding], kinds: PrimKinds
) -> Iterator[Any]:
    bound = {target.path for binding in bindings for target in binding.targets}
    for relationship in relationships:
        if relationship.GetName() == _BARE_NAMESPACE or (
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
        if not relationship:
            return Emptiness.UNAUTHORED, ()
        if relationship.GetPath() in seen:
            return Emptiness.CIRCULAR, ()
    lost: list[Any] = []
    emptiness = Emptiness.UNAUTHORED
    deleted: set[str] = set()
    specs = relationship.GetPropertyStack()  # weaker ones may be of an attribute
    for spec in (spec for spec in specs if isinstance(spec, Sdf.RelationshipSpec)):
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
