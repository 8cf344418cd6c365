"""Which fields Volumes use, or would use if nothing were wrong with them."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

from pxr import Usd

from usdvol_lint import schema
from usdvol_lint.cached import cached_property
from usdvol_lint.facts.prims.tables import Slot
from usdvol_lint.facts.usd.below import each_below
from usdvol_lint.facts.usd.instances import in_prototype, shown
from usdvol_lint.facts.usd.kinds import PrimKinds
from usdvol_lint.facts.volumes.bindings import BoundFields, FieldBindings
from usdvol_lint.facts.volumes.intended import FieldIndex
from usdvol_lint.facts.volumes.states import TargetState


class UsedFields:
    """The paths of the fields that are accounted for under any variant selection so far."""

    def __init__(self) -> None:
        self._paths: set[Any] = set()

    def add(self, paths: Iterable[Any]) -> None:
        self._paths.update(paths)

    def add_all_but(self, unused: set[Any], paths: Mapping[Any, Any]) -> set[Any]:
        """Adds paths, the keys, but for the unused ones; those of these that are not there yet.

        A dict keeps the hashes of its keys, and to hash a path anew takes long.
        """
        missing = self.missing_of(unused)
        self._paths.update(paths)
        self._paths -= missing
        return missing

    def missing_of(self, paths: set[Any]) -> set[Any]:
        """Those paths that are not accounted for yet."""
        return paths - self._paths

    def never_get(self, path: Any) -> Callable[[], bool]:
        """A predicate for later: whether no selection until then accounts for the path."""
        paths = self._paths
        return lambda: path not in paths


class Users:
    """The Volumes that target each live field, by its slot; `slots` has those of all fields."""

    def __init__(
        self, volumes: Iterable[tuple[Any, BoundFields]], slots: Mapping[Any, Slot]
    ) -> None:
        self._volumes = list(volumes)
        self._slots = slots
        self._counts = Counter(slot for _, fields in self._volumes for slot in fields.slots)

    def __contains__(self, slot: object) -> bool:
        return slot in self._counts

    def count(self, slot: Slot) -> int:
        """How many Volumes target a field."""
        return self._counts[slot]

    @cached_property
    def unbound(self) -> set[Any]:
        """The paths of the fields that no Volume targets."""
        return {path for path, slot in self._slots.items() if slot not in self._counts}

    def of(self, slot: Slot) -> list[Any]:
        """The Volumes that target a field."""
        return self._by_slot[slot]

    @cached_property
    def other_targets(self) -> frozenset[Any]:
        """The paths of all targets that are no live fields right below their Volume."""
        in_full = (fields.bindings for _, fields in self._volumes if fields.bindings)
        return frozenset(path for bindings in in_full for path in bindings.target_paths())

    @cached_property
    def _by_slot(self) -> dict[Slot, list[Any]]:
        found: dict[Slot, list[Any]] = defaultdict(list)
        for volume, fields in self._volumes:
            for slot in fields.slots:
                found[slot].append(volume)
        return found


def targets_of_unknown_type(
    volumes: Iterable[tuple[Any, BoundFields]], bindings: Callable[[Any], FieldBindings]
) -> frozenset[Any]:
    """The paths of the prims of unregistered types that Volumes target."""
    return frozenset(
        in_prototype(target.prim).GetPath()
        for volume, fields in volumes
        if TargetState.UNKNOWN_TYPE in fields.marks
        for _, target in bindings(volume).with_target(TargetState.UNKNOWN_TYPE)
    )


def accounted_for(
    volumes: Iterable[Any],
    bindings: Callable[[Any], FieldBindings],
    kinds: PrimKinds,
    index: FieldIndex,
) -> Iterator[Any]:
    """The paths of the fields that faulty Volumes probably intend to use.

    These are the fields below one, and those that its relationships were intended to target.
    """
    for volume in volumes:
        if not bindings(volume).is_sound:
            yield from (in_prototype(field).GetPath() for field in _fields_below(volume, kinds))
            yield from filter(None, map(index.intended_by, bindings(volume).bindings))


def accounted_for_by_others(prims: Iterable[Any], kinds: PrimKinds) -> Iterator[Any]:
    """The paths of the fields that prims would use if they were Volumes that are drawn."""
    for prim in prims:
        yield from (in_prototype(field).GetPath() for field in _fields_below(prim, kinds))
        for relationship in prim.GetAuthoredPropertiesInNamespace(schema.FIELD_NAMESPACE):
            if isinstance(relationship, Usd.Relationship):
                yield from _as_walked(prim.GetStage(), relationship.GetForwardedTargets())


def any_targets(stage: Any, field: Any, out_of_reach: Iterable[Any]) -> bool:
    """Whether a relationship targets the field at a path; traversals do not reach some prims."""
    roots = (stage.GetPseudoRoot(), *stage.GetPrototypes())
    targets = [path for root in roots for path in root.FindAllRelationshipTargetPaths()]
    for prim in out_of_reach:
        targets += (path for rel in prim.GetRelationships() for path in rel.GetForwardedTargets())
    return field in _as_walked(stage, targets)


def _as_walked(stage: Any, targets: Iterable[Any]) -> Iterator[Any]:
    """The paths of the prims at these paths as the walk meets them: in their prototypes."""
    prims = (stage.GetPrimAtPath(path.GetPrimPath()) for path in targets)
    return (in_prototype(prim).GetPath() for prim in prims if prim)


def unbound_fields(
    volume: Any, kinds: PrimKinds, slots: Mapping[Any, Slot], users: Users
) -> list[Any]:
    """The field prims below a Volume that no Volume targets."""
    below = _fields_below(volume, kinds)
    return [field for field in below if slots.get(in_prototype(field).GetPath()) not in users]


def is_shared(volume: Any, field: Any, slots: Mapping[Any, Slot], users: Users) -> bool:
    """Whether other Volumes, or other instances of this one, target the same field."""
    slot = slots.get(in_prototype(field).GetPath())
    if slot and users.count(slot) > 1:
        return True
    instanced = volume.IsInPrototype() and not field.IsInPrototype()
    return bool(instanced and shown(volume).instances > 1)


def _fields_below(prim: Any, kinds: PrimKinds) -> list[Any]:
    """The field prims below a prim, also inside instances: those of a prototype once."""
    return [each for each in each_below(prim) if kinds.is_a(each, schema.FIELD)]
