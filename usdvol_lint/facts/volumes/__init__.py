"""Facts about Volumes: which fields they bind, how these are placed, and what the extents miss."""

from __future__ import annotations

from collections.abc import Callable, Container, Sequence
from enum import Enum
from typing import TYPE_CHECKING, Any

from usdvol_lint import schema
from usdvol_lint.cached import cached_property
from usdvol_lint.deferred import deferred
from usdvol_lint.facts.found import Wing, column, fact, summary

with deferred(globals()):
    from usdvol_lint.facts.usd import instances, visibility
    from usdvol_lint.facts.volumes import (
        enclosure,
        intended,
        lookalikes,
        mixture,
        placement,
        reading,
        staging,
        targets,
        usage,
    )

if TYPE_CHECKING:
    from usdvol_lint.facts.files import Files
    from usdvol_lint.facts.grids import Grids
    from usdvol_lint.facts.grids.known import KnownBoxes
    from usdvol_lint.facts.layers import Layers
    from usdvol_lint.facts.prims import Prims
    from usdvol_lint.facts.prims.tables import Table, Tables
    from usdvol_lint.facts.usd.kinds import PrimKinds
    from usdvol_lint.facts.volumes.bindings import Binding, BoundFields, FieldBindings
    from usdvol_lint.facts.volumes.enclosure import Enclosure
    from usdvol_lint.facts.volumes.intended import FieldIndex
    from usdvol_lint.facts.volumes.lookalikes import Lookalike
    from usdvol_lint.facts.volumes.mixture import MixedFiles
    from usdvol_lint.facts.volumes.placement import Displacement
    from usdvol_lint.facts.volumes.reading import BindingReader
    from usdvol_lint.facts.volumes.shortfall import Shortfall
    from usdvol_lint.facts.volumes.staging import Staging
    from usdvol_lint.facts.volumes.targets import Target
    from usdvol_lint.facts.volumes.unmeasured import UnmeasuredGrids
    from usdvol_lint.facts.volumes.usage import UsedFields, Users


class Volumes(Wing):
    """The facts about Volumes.

    `used` are the fields that any variant selection so far uses, `boxes` those around grids that
    are known so far, of this stage and others.
    """

    def __init__(
        self,
        tables: Tables,
        stage: Any,
        kinds: PrimKinds,
        untyped: Sequence[Any],
        prims: Prims,
        files: Files,
        layers: Layers,
        grids: Grids,
        used: UsedFields,
        boxes: KnownBoxes,
    ) -> None:
        super().__init__(tables)
        self._stage = stage
        self._kinds = kinds
        self._untyped = untyped
        self._prims = prims
        self._files = files
        self._layers = layers
        self._grids = grids
        self._used = used
        self._boxes = boxes

    @column
    def bound_fields(self, table: Table) -> Sequence[BoundFields]:
        """The bindings of Volumes in brief."""
        return self._binding_reader.read_many(
            table.batch, table.authored, self.tables.field_slots, self._layers.may_lack
        )

    @summary
    def binding_marks(self, table: Table) -> Sequence[frozenset[Enum]]:
        """The states of a Volume's targets, and what else preconditions test of its bindings."""
        return [fields.marks for fields in self.bound_fields.all(table)]

    def bindings(self, volume: Any) -> FieldBindings:
        """The bindings of a Volume."""
        return self.bound_fields(volume).bindings or self._plain_bindings(volume)

    @fact
    def _plain_bindings(self, volume: Any) -> FieldBindings:
        """The bindings of a Volume of which `bound_fields` has only the slots."""
        return self._binding_reader.read(volume, self._layers.may_lack)

    def intended_field(self, binding: Binding) -> str | None:
        """The path of the field that a binding without one was probably intended to target."""
        path = self._field_index.intended_by(binding)
        return instances.shown_path(self._stage, path) if path else None

    def mistyping(self, target: Target) -> Any | None:
        """The spec that first gave a target a type that no field has; None if none gives it one."""
        return targets.mistyping(target.prim, self._kinds)

    def is_target_of_unknown_type(self, prim: Any) -> bool:
        """Whether a Volume targets a prim whose type is not registered."""
        return prim.GetPath() in self._targets_of_unknown_type

    def unbound_fields(self, volume: Any) -> list[Any]:
        """The field prims below a Volume that no Volume targets."""
        return usage.unbound_fields(volume, self._kinds, self.tables.field_slots, self._users)

    def is_shared(self, volume: Any, field: Any) -> bool:
        """Whether other Volumes, or other instances of this one, target the same field."""
        return usage.is_shared(volume, field, self.tables.field_slots, self._users)

    def staging(self, field: Any, time_range: tuple[float, float]) -> Staging:
        """How the Volumes that use a field are shown over a range of time, or else the field."""
        users = self._users.of(self.tables.field_slots[field.GetPath()])
        return staging.staging_of(field, users, self._prims.moved_prototypes, time_range)

    @cached_property
    def unused_fields(self) -> list[Any]:
        """The fields that no Volume targets, under this variant selection or one before it.

        What uses a field under this selection is added to `used`, for the selections to come.
        There are none where part of the stage can't be read, and without Volumes none but the only
        field of the stage: several are a library.  Fields are left out that a faulty Volume
        accounts for, also one that is not drawn, or whose type is hidden or missing: those below
        it, and those that its relationships probably intended.
        """
        slots, layers = self.tables.field_slots, self._layers
        unused = self._used.add_all_but(self._users.unbound, slots)
        volumes = self._prims.of(schema.VOLUME)
        is_library = not volumes and len(slots) > 1
        if is_library or not unused or not layers.are_whole:
            return []
        if not volumes and usage.any_targets(self._stage, next(iter(slots)), layers.out_of_reach):
            return []  # by a prim that is no Volume, or is not there: a finding of its own
        if not {prim for prim, _ in self.tables.unreadable}.isdisjoint(volumes):
            return []  # what these target is unknown
        self._used.add(usage.accounted_for(volumes, self.bindings, self._kinds, self._field_index))
        others = [prim for prim in layers.overs.undrawn if self._prims.is_a(prim, schema.VOLUME)]
        others += (each.prim for each in layers.retyped)
        others += (each.prim for each in self.lookalikes)
        self._used.add(usage.accounted_for_by_others(others, self._kinds))
        return [self._stage.GetPrimAtPath(path) for path in sorted(self._used.missing_of(unused))]

    @cached_property
    def lookalikes(self) -> list[Lookalike]:
        """The prims of no type, Xforms and Scopes with the data of a Volume or splat, by path.

        Left out are those whose type is hidden, and those that may lack opinions.
        """
        unbound = self._users.unbound
        if not (unbound or self._untyped):
            return []
        return lookalikes.lookalikes(self._stage, self._untyped, unbound, self._layers)

    def stays_unused(self, field: Any) -> Callable[[], bool]:
        """A predicate for later: whether no variant selection until then uses the field."""
        return self._used.never_get(field.GetPath())

    def is_hidden(self, field: Any, times: Sequence[float], between: bool = False) -> bool:
        """Whether a field, or each Volume that binds it, is invisible at, or `between`, times."""
        users = self._users.of(self.tables.field_slots[field.GetPath()])
        return visibility.is_hidden(field, users, times, between)

    def displacement(self, volume: Any, field: Any) -> Displacement | None:
        """How transforms move a field relative to a Volume that binds it, if they do."""
        return placement.displacement(volume, field)

    def are_apart(self, volume: Any, fields: Container[str]) -> bool:
        """Whether one of these fields is outside a Volume and does not move with it."""
        return any(
            target.shown in fields and self.displacement(volume, target.prim)
            for _, target in self.bindings(volume).outside(volume)
        )

    @summary
    def overhangs(self, table: Table) -> Sequence[float]:
        """Upper bounds on how far grids reach out of extents, relative to their coordinates."""
        return self._enclosure.overhangs(table, self.bound_fields.all(table))

    def shortfall(self, volume: Any, relative_slack: float) -> Shortfall | None:
        """By how much an authored extent fails to enclose the grids of a Volume, if it does."""
        return self._enclosure.shortfall(volume, self.bindings(volume), relative_slack)

    def fitting_extent(self, volume: Any) -> str | None:
        """The statement of an extent around all grids of a Volume, where all of them are known."""
        return self._enclosure.fitting(volume, self.bindings(volume))

    def unmeasured_grids(self, volume: Any) -> UnmeasuredGrids | None:
        """The grids with which the authored extent of a Volume can't be compared, if there are."""
        return self._enclosure.unmeasured(volume, self.bindings(volume))

    def mixed_files(self, volume: Any, is_told: Callable[[Any], bool]) -> MixedFiles | None:
        """The different files that fields of a Volume but those told name at one time, if any."""
        return mixture.find_mixed_files(self.bindings(volume), self._files.paths, is_told)

    def is_targeted(self, prim: Any) -> bool:
        """Whether a live Volume targets a prim, also one that is no live field."""
        return prim.GetPath() in self._users.other_targets

    @cached_property
    def _targets_of_unknown_type(self) -> frozenset[Any]:
        """The paths of the prims of unregistered types that Volumes target."""
        bound = self.bound_fields.readable(schema.VOLUME)
        return usage.targets_of_unknown_type(bound, self.bindings)

    @cached_property
    def _users(self) -> Users:
        return usage.Users(self.bound_fields.readable(schema.VOLUME), self.tables.field_slots)

    @cached_property
    def _field_index(self) -> FieldIndex:
        return intended.FieldIndex(self._prims.of(schema.FIELD), self._prims.of(schema.VOLUME))

    @cached_property
    def _binding_reader(self) -> BindingReader:
        return reading.BindingReader(self._kinds)

    @cached_property
    def _enclosure(self) -> Enclosure:
        return enclosure.Enclosure(self.tables, self._prims, self._files, self._grids, self._boxes)
