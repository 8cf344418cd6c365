"""Whether the authored extent of a Volume encloses the grids that its fields name."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from usdvol_lint.facts.files import Files
from usdvol_lint.facts.grids import Grids
from usdvol_lint.facts.grids.timelines import Timeline
from usdvol_lint.facts.prims import Prims
from usdvol_lint.facts.prims.tables import Table, Tables
from usdvol_lint.facts.usd.instances import in_prototype
from usdvol_lint.facts.volumes.bindings import Bound, FieldBindings, Target
from usdvol_lint.facts.volumes.hulls import GridBoxes, Hulls
from usdvol_lint.facts.volumes.placement import AT_REST, Placement, read_placements
from usdvol_lint.facts.volumes.shortfall import PlacedField, Shortfall, find_shortfall


class Enclosure:
    """Finds what the fields of Volumes have in their files, and holds extents against that."""

    def __init__(self, tables: Tables, prims: Prims, files: Files, grids: Grids) -> None:
        self._tables = tables
        self._prims = prims
        self._files = files
        self._grids = grids
        self._boxes = GridBoxes()
        self._hulls = Hulls(self._boxes)

    def overhangs(self, table: Table, bounds: Iterable[Bound]) -> list[float]:
        """How far grids may reach out of each extent, in relation to their largest coordinate."""
        overhang, placed = self._hulls.overhang, self._placed
        columns = zip(table.prims, self._prims.limits.each(table), bounds, strict=True)
        return [
            overhang(limits, placed(volume, bound)) if limits.are_authored else 0.0
            for volume, limits, bound in columns
        ]

    def shortfall(
        self, volume: Any, bindings: FieldBindings, relative_slack: float
    ) -> Shortfall | None:
        """What the grids of a Volume have outside its extent, if one is authored."""
        limits = self._prims.limits(volume)
        if not limits.are_authored:
            return None
        fields = [
            PlacedField(target, self._files.paths(field), timeline, placement, shown_at)
            for target, field, timeline in self._with_grids(bindings)
            for shown_at, placement in read_placements(volume, target.prim)
        ]
        return find_shortfall(limits, fields, self._boxes, relative_slack)

    def _placed(self, volume: Any, bound: Bound) -> list[tuple[Timeline, Placement]]:
        """The contents of the files that a Volume gets, and where their fields stand."""
        if bound.looked_at:
            return [
                (timeline, placement)
                for target, _, timeline in self._with_grids(bound.looked_at)
                for _, placement in read_placements(volume, target.prim)
            ]
        timelines = self._grids.timelines
        found = []
        for place in bound.fields:
            table, row = self._tables.find_at(place)
            timeline = timelines.at(table, row)
            if "xformOpOrder" in table.authored.declared:
                placements = read_placements(volume, table.prims[row])
                found += [(timeline, placement) for _, placement in placements]
            else:
                found.append((timeline, AT_REST))
        return found

    def _with_grids(self, bindings: FieldBindings) -> Iterator[tuple[Target, Any, Timeline]]:
        """The fields, as targets and as the walk met them, whose files have the grids they name."""
        for _, target in bindings.with_files():
            field = in_prototype(target.prim)
            timeline = self._grids.timelines(field)
            if timeline.selects_grids:
                yield target, field, timeline
