"""What Volumes bind, where that stands, and whether their extents enclose it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from enum import Enum
from functools import cached_property
from typing import TYPE_CHECKING, Any

from usdvol_lint import schema
from usdvol_lint.facts.found import Wing, column, fact, summary

if TYPE_CHECKING:
    from usdvol_lint.facts.files import Files
    from usdvol_lint.facts.grids import Grids
    from usdvol_lint.facts.layers import Layers
    from usdvol_lint.facts.prims import Prims
    from usdvol_lint.facts.prims.tables import Slot, Table, Tables
    from usdvol_lint.facts.usd.kinds import Kinds
    from usdvol_lint.facts.volumes.bindings import Binding, Bound, FieldBindings
    from usdvol_lint.facts.volumes.enclosure import Enclosure
    from usdvol_lint.facts.volumes.intended import FieldNames
    from usdvol_lint.facts.volumes.mixture import MixedFiles
    from usdvol_lint.facts.volumes.placement import Displacement
    from usdvol_lint.facts.volumes.reading import BindingReader
    from usdvol_lint.facts.volumes.shortfall import Shortfall
    from usdvol_lint.facts.volumes.usage import UsedFields


class Volumes(Wing):
    """The fields of Volumes; `used` are those that other variant selections use."""

    def __init__(
        self,
        tables: Tables,
        stage: Any,
        kinds: Kinds,
        prims: Prims,
        files: Files,
        layers: Layers,
        grids: Grids,
        used: UsedFields,
    ) -> None:
        super().__init__(tables)
        self._stage = stage
        self._kinds = kinds
        self._prims = prims
        self._files = files
        self._layers = layers
        self._grids = grids
        self._used = used

    @column
    def bound(self, table: Table) -> Sequence[Bound]:
        """What the `field:` namespaces of Volumes bind, in brief."""
        return self._binding_reader.read_many(
            table.batch, table.authored, self.tables.fields, self._layers.may_lack
        )

    @summary
    def binding_marks(self, table: Table) -> Sequence[frozenset[Enum]]:
        """What is remarkable about what the `field:` namespace of a Volume binds."""
        return [bound.marks for bound in self.bound.each(table)]

    def bindings(self, volume: Any) -> FieldBindings:
        """What the `field:` namespace of a Volume really binds."""
        return self.bound(volume).looked_at or self._plain_bindings(volume)

    @fact
    def _plain_bindings(self, volume: Any) -> FieldBindings:
        return self._binding_reader.read(volume, self._layers.may_lack)

    def intended_field(self, binding: Binding) -> str | None:
        """The field that a relationship which binds none was probably meant to target."""
        from usdvol_lint.facts.usd.instances import shown_path

        path = self._field_names.meant_by(binding)
        return shown_path(self._stage, path) if path else None

    def unbound_fields(self, volume: Any) -> list[Any]:
        """The field prims below a Volume that no Volume targets."""
        from usdvol_lint.facts.volumes.usage import unbound_fields

        return unbound_fields(volume, self._kinds, self.tables.fields, self._users)

    def is_shared(self, volume: Any, field: Any) -> bool:
        """Whether other Volumes target a field of this one too, or instances of this one do."""
        from usdvol_lint.facts.volumes.usage import is_shared

        return is_shared(volume, field, self.tables.fields, self._users)

    @cached_property
    def unused_fields(self) -> list[Any]:
        """The fields that no Volume targets, on a stage of which all could be seen.

        Those are left out that something wrong with a Volume accounts for: they lie below it, or
        a broken relationship was probably meant to target them.
        """
        from usdvol_lint.facts.volumes.usage import accounted_for

        places, used = self.tables.fields, self._users
        self._used.add(path for path, place in places.items() if place in used)
        volumes = self._prims.of(schema.VOLUME)
        if not volumes or not self._used.missing_of(places) or not self._layers.are_whole:
            return []
        if not {prim for prim, _ in self.tables.unreadable}.isdisjoint(volumes):
            return []  # nobody knows what these target
        for volume in volumes:
            self._used.add(
                accounted_for(volume, self.bindings(volume), self._kinds, self._field_names)
            )
        return [self._stage.GetPrimAtPath(path) for path in sorted(self._used.missing_of(places))]

    def stays_unused(self, field: Any) -> Callable[[], bool]:
        """Asks, once more variant selections were looked at, whether none of them uses a field."""
        return self._used.never_get(field.GetPath())

    def displacement(self, volume: Any, field: Any) -> Displacement | None:
        """How a field is moved in relation to a Volume that binds it, if it is."""
        from usdvol_lint.facts.volumes.placement import displacement

        return displacement(volume, field)

    @summary
    def overhangs(self, table: Table) -> Sequence[float]:
        """How far grids may reach out of extents, in relation to their largest coordinate."""
        return self._enclosure.overhangs(table, self.bound.each(table))

    def shortfall(self, volume: Any, relative_slack: float) -> Shortfall | None:
        """What the grids of a Volume have outside its extent, if one is authored."""
        return self._enclosure.shortfall(volume, self.bindings(volume), relative_slack)

    def mixed_files(self, volume: Any) -> MixedFiles | None:
        """The different files that the fields of a Volume name at one time, if they do."""
        if len(self.bindings(volume).bindings) < 2:
            return None
        from usdvol_lint.facts.usd.instances import in_prototype
        from usdvol_lint.facts.volumes.mixture import find_mixed_files

        named = [
            (binding.name, self._files.paths(in_prototype(target.prim)))
            for binding, target in self.bindings(volume).with_files()
        ]
        return find_mixed_files(named) if len(named) > 1 else None

    @cached_property
    def _users(self) -> Counter[Slot]:
        """How many Volumes target each live field that one does, by its place."""
        volumes = self.bound.readable(schema.VOLUME)
        return Counter(place for _, bound in volumes for place in bound.fields)

    @cached_property
    def _field_names(self) -> FieldNames:
        from usdvol_lint.facts.volumes.intended import FieldNames

        return FieldNames(self._prims.of(schema.FIELD), self._prims.of(schema.VOLUME))

    @cached_property
    def _binding_reader(self) -> BindingReader:
        from usdvol_lint.facts.volumes.reading import BindingReader

        return BindingReader(self._kinds)

    @cached_property
    def _enclosure(self) -> Enclosure:
        from usdvol_lint.facts.volumes.enclosure import Enclosure

        return Enclosure(self.tables, self._prims, self._files, self._grids)
