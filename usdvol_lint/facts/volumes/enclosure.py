"""Whether authored extents of Volumes enclose the grids that their fields name."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any

from usdvol_lint.facts.files import Files
from usdvol_lint.facts.grids import Grids
from usdvol_lint.facts.grids.known import KnownBoxes
from usdvol_lint.facts.grids.timelines import Timeline
from usdvol_lint.facts.prims import Prims
from usdvol_lint.facts.prims.tables import Table, Tables
from usdvol_lint.facts.usd.instances import in_prototype
from usdvol_lint.facts.volumes.bindings import BoundFields, FieldBindings
from usdvol_lint.facts.volumes.hulls import GridBoxes, Hulls
from usdvol_lint.facts.volumes.placement import (
    UNTRANSFORMED,
    Placement,
    displacement,
    read_placements,
)
from usdvol_lint.facts.volumes.targets import Target

if TYPE_CHECKING:
    from usdvol_lint.facts.volumes.shortfall import PlacedField, Shortfall
    from usdvol_lint.facts.volumes.unmeasured import UnmeasuredGrids


class Enclosure:
    """Compares extents with the grids in the files of the fields."""

    def __init__(
        self, tables: Tables, prims: Prims, files: Files, grids: Grids, known: KnownBoxes
    ) -> None:
        self._tables = tables
        self._prims = prims
        self._files = files
        self._timelines = grids.timelines
        self._boxes = GridBoxes(known)
        self._hulls = Hulls(self._boxes)

    def overhangs(self, table: Table, bound_fields: Iterable[BoundFields]) -> list[float]:
        """For each Volume what `Hulls.overhang` says; 0 without an authored extent."""
        overhang, placed = self._hulls.overhang, self._placed
        columns = zip(table.prims, self._prims.limits.all(table), bound_fields, strict=True)
        return [
            overhang(limits, placed(volume, fields)) if limits.are_authored else 0.0
            for volume, limits, fields in columns
        ]

    def shortfall(
        self, volume: Any, bindings: FieldBindings, relative_slack: float
    ) -> Shortfall | None:
        """By how much an authored extent fails to enclose the grids of a Volume, if it does."""
        from usdvol_lint.facts.volumes.shortfall import find_shortfall

        limits = self._prims.limits(volume)
        if not limits.are_authored:
            return None
        fields = self._placed_fields(volume, bindings)
        return find_shortfall(limits, fields, self._boxes, relative_slack)

    def fitting(self, volume: Any, bindings: FieldBindings) -> str | None:
        """The statement of an extent around all grids of a Volume, if each of them is known.

        None also where a field does not move with the Volume: then no extent is the remedy.
        """
        from usdvol_lint.facts.volumes.shortfall import fitting_all

        if not bindings.is_sound:
            return None
        if any(displacement(volume, target.prim) for _, target in bindings.outside(volume)):
            return None
        fields = self._placed_fields(volume, bindings)
        bound = {target.shown for binding in bindings.bindings for target in binding.targets}
        is_whole = {field.shown for field in fields} == bound
        return fitting_all(fields, self._boxes) if is_whole else None

    def unmeasured(self, volume: Any, bindings: FieldBindings) -> UnmeasuredGrids | None:
        """The grids with which the authored extent of a Volume can't be compared, if there are."""
        from usdvol_lint.facts.volumes.unmeasured import find_unmeasured

        limits = self._prims.limits(volume)
        if not limits.are_authored:
            return None
        fields = [(target.shown, timeline) for target, _, timeline in self._with_grids(bindings)]
        return find_unmeasured(limits.attribute, fields)

    def _placed_fields(self, volume: Any, bindings: FieldBindings) -> list[PlacedField]:
        """The fields of a Volume in some of whose files the grids were found."""
        from usdvol_lint.facts.volumes.shortfall import PlacedField

        return [
            PlacedField(target, self._files.paths(field), timeline, placement, shown_at)
            for target, field, timeline in self._with_grids(bindings)
            for shown_at, placement in read_placements(volume, target.prim)
        ]

    def _placed(self, volume: Any, fields: BoundFields) -> list[tuple[Timeline, Placement]]:
        """The files of each bound field over time, with the field's placement."""
        if fields.bindings:
            return [
                (timeline, placement)
                for target, _, timeline in self._with_grids(fields.bindings)
                for _, placement in read_placements(volume, target.prim)
            ]
        timelines = self._timelines
        placed = []
        for slot in fields.slots:
            table, row = self._tables.find_at(slot)
            timeline = timelines.at(table, row)
            if "xformOpOrder" in table.authored.declared:
                placements = read_placements(volume, table.prims[row])
                placed += [(timeline, placement) for _, placement in placements]
            else:
                placed.append((timeline, UNTRANSFORMED))
        return placed

    def _with_grids(self, bindings: FieldBindings) -> Iterator[tuple[Target, Any, Timeline]]:
        """The fields in some of whose files the named grid was found: target, prim and files."""
        for _, target in bindings.with_files():
            field = in_prototype(target.prim)
            timeline = self._timelines(field)
            if timeline.selects_grids:
                yield target, field, timeline
