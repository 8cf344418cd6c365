"""The grids that fields ask for, and those that their files hold."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Hashable, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

from usdvol_lint import schema
from usdvol_lint.facts.found import Wing, column, summary

if TYPE_CHECKING:
    from usdvol_lint.facts.files import Files
    from usdvol_lint.facts.grids.changes import GridChanges
    from usdvol_lint.facts.grids.claims import ClaimReader, FieldClaims
    from usdvol_lint.facts.grids.contents import ContentClass
    from usdvol_lint.facts.grids.reader import ContentReader
    from usdvol_lint.facts.grids.timelines import FieldContents, Timeline
    from usdvol_lint.facts.prims.tables import Table, Tables
    from usdvol_lint.volumefile.cache import VolumeFiles


class Grids(Wing):
    """What fields say of the content of their files, held against that content.

    `content` says how many of a field's files are looked into: all, first or off; `volume_files`
    has those that were read already; `advance` is told of progress in long sequences.
    """

    def __init__(
        self,
        tables: Tables,
        files: Files,
        content: str,
        volume_files: VolumeFiles,
        advance: Callable[[int], None],
    ) -> None:
        super().__init__(tables)
        self._files = files
        self._content = content
        self._volume_files = volume_files
        self._advance = advance

    @column
    def claims(self, table: Table) -> Sequence[FieldClaims]:
        """What fields say of the content of their files."""
        return self._claim_reader.read(table.batch, table.authored)

    @column
    def timelines(self, table: Table) -> Sequence[Timeline]:
        """What is inside the files that fields name, over time; fields may share one."""
        paths, claims = self._files.paths.each(table), self.claims.each(table)
        return self._content_reader.read(paths, claims, table.authored)

    @summary
    def content_classes(self, table: Table) -> Sequence[tuple[ContentClass, ...]]:
        """The classes of what is inside the files that a field names."""
        return [
            tuple([each for each, _ in timeline.classes]) for timeline in self.timelines.each(table)
        ]

    def contents(self, field: Any) -> FieldContents:
        """What is inside the files that a field names."""
        from usdvol_lint.facts.grids.timelines import FieldContents

        return FieldContents(self._files.paths(field).attribute, self.timelines(field))

    def changes(self, field: Any) -> GridChanges | None:
        """Where the grids along a field's sequence are others than in most of its frames.

        Of the fields that share a sequence, the first one is told.
        """
        timeline = self.timelines(field)
        if len(timeline.classes) < 2:
            return None
        from usdvol_lint.facts.grids.changes import find_grid_changes

        sharing = self._sharing[tuple(timeline.files)]
        return find_grid_changes(list(map(self.contents, sharing))) if sharing[0] == field else None

    @cached_property
    def _sharing(self) -> Mapping[Hashable, list[Any]]:
        """The fields that name the same files at the same times."""
        found: dict[Hashable, list[Any]] = defaultdict(list)
        for field, timeline in self.timelines.readable(schema.FIELD_ASSET):
            found[tuple(timeline.files)].append(field)
        return found

    @cached_property
    def _claim_reader(self) -> ClaimReader:
        from usdvol_lint.facts.grids.claims import ClaimReader

        return ClaimReader()

    @cached_property
    def _content_reader(self) -> ContentReader:
        from usdvol_lint.facts.grids.reader import ContentReader

        return ContentReader(self._volume_files, self._content, self._advance)
