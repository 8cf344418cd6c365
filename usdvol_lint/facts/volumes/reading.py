"""Reads what Volumes bind: many at once where all is plain, else one Volume at a time."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from enum import Enum
from typing import TYPE_CHECKING, Any

from pxr import Usd

from usdvol_lint import schema
from usdvol_lint.facts.prims.attributes import Authored
from usdvol_lint.facts.usd.batches import PrimBatch
from usdvol_lint.facts.usd.calls import (
    get_name,
    get_properties,
    get_stage,
    own_targets,
    parent_path,
)
from usdvol_lint.facts.usd.forwarding import Forwarding
from usdvol_lint.facts.usd.instances import shown_path
from usdvol_lint.facts.usd.kinds import PrimKinds
from usdvol_lint.facts.volumes.bindings import Binding, BoundFields, FieldBindings
from usdvol_lint.facts.volumes.emptiness import Reason, why_empty
from usdvol_lint.facts.volumes.states import BindingMark, TargetState
from usdvol_lint.facts.volumes.targets import MayLack, read_target

if TYPE_CHECKING:
    from usdvol_lint.facts.prims.tables import Slot

_BARE_NAMESPACE = schema.FIELD_NAMESPACE.rstrip(":")


class BindingReader:
    """Reads what Volumes bind.

    `live` maps the paths of live fields to their slots; `may_lack` tells whether a layer that does
    not open may hold opinions about a prim.
    """

    def __init__(self, kinds: PrimKinds) -> None:
        self._kinds = kinds
        self._forwarding = Forwarding()
        self._reasons: dict[Any, Reason] = {}

    def read_many(
        self, batch: PrimBatch, authored: Authored, live: Mapping[Any, Slot], may_lack: MayLack
    ) -> list[BoundFields]:
        """Reads many Volumes on which the same properties are authored.

        Bindings are read one by one only for a Volume with a target that is not a live field right
        below it, or with a relationship that no schema declares.
        """
        marks: set[Enum] = {TargetState.FIELD}
        if len(authored.bound) > 1:
            marks.add(BindingMark.SEVERAL)
        if any(name.count(":") > 1 for name in authored.bound):
            marks.add(BindingMark.NESTED)
        plain = frozenset(marks)
        paths = batch.paths
        columns = [_children(batch.relationships(name), paths, live) for name in authored.bound]
        rows = list(zip(*columns, strict=True)) if columns else [(None,)] * len(batch.prims)
        if len(columns) > 1:  # two relationships may target one field
            rows = [tuple(dict.fromkeys(slots)) for slots in rows]
        for name in authored.undeclared:
            for row, relationship in enumerate(batch.relationships(name)):
                if relationship:
                    rows[row] = (None,)
        return [
            self._in_full(volume, live, may_lack) if None in slots else BoundFields(plain, slots)
            for volume, slots in zip(batch.prims, rows, strict=True)
        ]

    def _in_full(self, volume: Any, live: Mapping[Any, Slot], may_lack: MayLack) -> BoundFields:
        bindings = self.read(volume, may_lack)
        paths = sorted(bindings.target_paths())
        slots = tuple(live[path] for path in paths if path in live)
        return BoundFields(bindings.marks(volume), slots, bindings)

    def read(self, volume: Any, may_lack: MayLack) -> FieldBindings:
        """Reads all bindings of one Volume."""
        bindings, others = [], []
        for prop in get_properties(volume):
            name = get_name(prop)
            if name.startswith(schema.FIELD_NAMESPACE):
                name = name[len(schema.FIELD_NAMESPACE) :]
                bindings.append(self._binding(volume, prop, name, may_lack))
            elif isinstance(prop, Usd.Relationship):
                others.append(prop)
        undeclared = tuple(_undeclared(others, bindings, self._kinds)) if others else ()
        return FieldBindings(tuple(bindings), undeclared)

    def _binding(self, volume: Any, prop: Any, name: str, may_lack: MayLack) -> Binding:
        if not isinstance(prop, Usd.Relationship):
            return Binding(prop, name, False)
        paths = self._forwarding.targets(prop)
        if paths:
            targets = tuple([read_target(volume, path, self._kinds, may_lack) for path in paths])
            return Binding(prop, name, True, targets)
        emptiness, lost = why_empty(prop, self._reasons)
        stage = get_stage(prop)
        forwards_to = "".join(shown_path(stage, path) for path in prop.GetTargets()[:1])
        return Binding(prop, name, True, (), emptiness, lost, forwards_to)


def _children(
    relationships: Iterable[Any], volumes: Iterable[Any], live: Mapping[Any, Slot]
) -> list[Slot | None]:
    """The slot of each relationship's target if it is a single live field right below the Volume.

    `volumes` are the paths of the Volumes.
    """
    slots: list[Slot | None] = []
    for relationship, volume in zip(relationships, volumes, strict=True):
        paths: Sequence[Any] = own_targets(relationship) if relationship else ()
        is_child = len(paths) == 1 and parent_path(paths[0]) == volume
        slots.append(live.get(paths[0]) if is_child else None)
    return slots


def _undeclared(
    relationships: Iterable[Any], bindings: Sequence[Binding], kinds: PrimKinds
) -> Iterator[Any]:
    """The relationships outside the namespace that were probably intended as bindings.

    One with the name of a binding is none: the binding may have forwarded to it.
    """
    names = {binding.key for binding in bindings}
    bound = {target.path for binding in bindings for target in binding.targets}
    for relationship in relationships:
        if relationship.GetName() == _BARE_NAMESPACE or (
            relationship.GetBaseName() not in names
            and not _is_declared(relationship)
            and any(
                path not in bound and kinds.is_a(prim, schema.FIELD)
                for path in relationship.GetForwardedTargets()
                if path.IsPrimPath() and (prim := relationship.GetStage().GetPrimAtPath(path))
            )
        ):
            yield relationship


def _is_declared(relationship: Any) -> bool:
    """Whether a schema of the prim declares it, as CollectionAPI does `collection:…:includes`."""
    definition = relationship.GetPrim().GetPrimDefinition()
    return relationship.GetName() in definition.GetPropertyNames()
