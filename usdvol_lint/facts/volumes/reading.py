"""Reads what Volumes bind: in columns, and one Volume at a time where something is unusual."""

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
    get_targets,
    parent_path,
)
from usdvol_lint.facts.usd.instances import shown_path
from usdvol_lint.facts.usd.kinds import Kinds
from usdvol_lint.facts.volumes.bindings import Binding, Bound, FieldBindings
from usdvol_lint.facts.volumes.emptiness import why_empty
from usdvol_lint.facts.volumes.states import BindingMark, TargetState
from usdvol_lint.facts.volumes.targets import MayLack, read_target

if TYPE_CHECKING:
    from usdvol_lint.facts.prims.tables import Slot

_BARE_NAMESPACE = schema.FIELD_NAMESPACE.rstrip(":")


class BindingReader:
    """Reads what Volumes bind.

    `may_lack` is asked whether opinions about a prim may lie in a layer that does not open.
    """

    def __init__(self, kinds: Kinds) -> None:
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
        paths = bindings.target_paths()
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
        undeclared = tuple(_undeclared(others, bindings, self._kinds)) if others else ()
        return FieldBindings(tuple(bindings), undeclared)

    def _binding(self, prop: Any, name: str, may_lack: MayLack) -> Binding:
        if not isinstance(prop, Usd.Relationship):
            return Binding(prop, name, False)
        stage = get_stage(prop)
        paths = get_targets(prop)
        if paths:
            targets = tuple([read_target(stage, path, self._kinds, may_lack) for path in paths])
            return Binding(prop, name, True, targets)
        emptiness, lost = why_empty(prop)
        forwards_to = "".join(shown_path(stage, path) for path in prop.GetTargets()[:1])
        return Binding(prop, name, True, (), emptiness, lost, forwards_to)


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


def _undeclared(
    relationships: Iterable[Any], bindings: Iterable[Binding], kinds: Kinds
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
