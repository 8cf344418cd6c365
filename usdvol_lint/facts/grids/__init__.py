"""What fields claim about their grids, and the grids that their files hold."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Hashable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from usdvol_lint import schema
from usdvol_lint.cached import cached_property
from usdvol_lint.deferred import deferred
from usdvol_lint.facts.found import Wing, column, summary

with deferred(globals()):
    from usdvol_lint.facts.grids import changes, nvidia_index, reader, timelines
    from usdvol_lint.facts.usd import instances

if TYPE_CHECKING:
    from usdvol_lint.facts.files import Files
    from usdvol_lint.facts.grids.changes import GridChanges
    from usdvol_lint.facts.grids.claims import FieldClaims
    from usdvol_lint.facts.grids.contents import ContentClass
    from usdvol_lint.facts.grids.known import KnownContents
    from usdvol_lint.facts.grids.reader import ContentReader
    from usdvol_lint.facts.grids.timelines import FieldContents, Timeline
    from usdvol_lint.facts.prims.tables import Table, Tables


class Grids(Wing):
    """What fields claim about the content of their files, and that content.

    `content` is how many of a field's files are read: all, first or off; `known` keeps what was
    read, for other stages too; `advance` is told of progress in long sequences.
    """

    def __init__(
        self,
        tables: Tables,
        files: Files,
        content: str,
        known: KnownContents,
        advance: Callable[[int], None],
    ) -> None:
        super().__init__(tables)
        self._files = files
        self._content = content
        self._known = known
        self._advance = advance

    @column
    def claims(self, table: Table) -> Sequence[FieldClaims]:
        """What each field claims about the content of its files."""
        return self._known.claims.read(table.batch, table.authored)

    @column
    def timelines(self, table: Table) -> Sequence[Timeline]:
        """The contents of each field's files, over time; fields may share a timeline."""
        paths, claims = self._files.paths.all(table), self.claims.all(table)
        return self._content_reader.read(paths, claims, table.authored)

    @summary
    def content_classes(self, table: Table) -> Sequence[tuple[ContentClass, ...]]:
        """The classes of the contents of each field's files."""
        return [
            tuple([each for each, _ in timeline.classes]) for timeline in self.timelines.all(table)
        ]

    def contents(self, field: Any) -> FieldContents:
        """The contents of a field's files."""
        return timelines.FieldContents(self._files.paths(field).attribute, self.timelines(field))

    def unswapped(self, field: Any) -> FieldContents:
        """The same but those that AST006 tells: of another format, as their extension shows."""
        contents = self.contents(field)
        return contents.without_swapped() if self.tables.tells("AST006") else contents

    def changes(self, field: Any) -> GridChanges | None:
        """The frames of a field's sequence that hold other grids than most of its frames.

        None for all but the first, by path, of the fields that share a sequence.
        """
        timeline = self.timelines(field)
        if len(timeline.classes) < 2:
            return None
        sharing = instances.as_shown(self._sharing[tuple(timeline.files)])
        return (
            changes.find_grid_changes(list(map(self.contents, sharing)))
            if sharing[0] == field
            else None
        )

    @cached_property
    def _sharing(self) -> Mapping[Hashable, list[Any]]:
        """Fields by their files and times: those that name the same files at the same times."""
        found: dict[Hashable, list[Any]] = defaultdict(list)
        for field, timeline in self.timelines.readable(schema.FIELD_ASSET):
            found[tuple(timeline.files)].append(field)
        return found

    @cached_property
    def _content_reader(self) -> ContentReader:
        return reader.ContentReader(self._known, self._content, self._advance)

    def is_for_index(self, field: Any) -> bool:
        """Whether a field or the prim above it has settings of NVIDIA IndeX."""
        return nvidia_index.is_for_index(field)
