"""The files that asset attributes name: what each value resolves to, and what is there."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from enum import Enum
from typing import TYPE_CHECKING, Any

from usdvol_lint import schema
from usdvol_lint.cached import cached_property
from usdvol_lint.deferred import deferred
from usdvol_lint.facts.files.states import AssetState
from usdvol_lint.facts.found import Wing, column, fact, summary

with deferred(globals()):
    from usdvol_lint.facts.files import (
        absences,
        alike,
        animation,
        classify,
        corrections,
        families,
        gaps,
        holes,
        in_variants,
        letter_case,
        malformed,
        marks,
        order,
        origins,
        sequences,
        stillness,
    )
    from usdvol_lint.facts.usd import hidden

if TYPE_CHECKING:
    from usdvol_lint.facts.files.absences import Absences
    from usdvol_lint.facts.files.alike import Namesakes
    from usdvol_lint.facts.files.animation import EmptyClip
    from usdvol_lint.facts.files.assets import Affected, AssetSamples
    from usdvol_lint.facts.files.classify import AssetReader
    from usdvol_lint.facts.files.corrections import Absence
    from usdvol_lint.facts.files.disk import Disk
    from usdvol_lint.facts.files.families import Families
    from usdvol_lint.facts.files.gaps import Missing
    from usdvol_lint.facts.files.holes import Holes
    from usdvol_lint.facts.files.in_variants import VariantPath
    from usdvol_lint.facts.files.letter_case import Recased
    from usdvol_lint.facts.files.malformed import Malformed
    from usdvol_lint.facts.files.marks import PathMarks
    from usdvol_lint.facts.files.order import OutOfOrder
    from usdvol_lint.facts.files.sequences import SampleSequence
    from usdvol_lint.facts.files.stillness import Packs, Still
    from usdvol_lint.facts.prims.tables import Table, Tables
    from usdvol_lint.facts.usd.clips import Clips


class Files(Wing):
    """The files that the `filePath` of fields names.

    `disk` looks at files and folders; `advance` is told of progress in long sequences.
    `has_range` says that there is a range of frames beside that of the stage.
    """

    def __init__(
        self,
        tables: Tables,
        stage: Any,
        clips: Clips,
        disk: Disk,
        advance: Callable[[int], None],
        has_range: bool,
    ) -> None:
        super().__init__(tables)
        self._stage = stage
        self._clips = clips
        self._disk = disk
        self._advance = advance
        self._has_range = has_range

    @column
    def paths(self, table: Table) -> Sequence[AssetSamples]:
        """Every value of `filePath`, resolved and classified."""
        return self._reader.read(table.batch, "filePath")

    @summary
    def path_marks(self, table: Table) -> Sequence[frozenset[Enum]]:
        """The states of the values of `filePath`, and further properties."""
        return self._marks.of(self.paths.all(table), table.authored)

    @fact
    def sequence(self, field: Any) -> SampleSequence | None:
        """The time samples of `filePath` as a sequence, or None if there are fewer than two."""
        return sequences.read_sequence(self.paths(field))

    def missing_samples(self, field: Any) -> Missing | None:
        """The samples that the sequence of `filePath` lacks, if it is regular otherwise."""
        sequence = self.sequence(field)
        return gaps.find_missing(sequence) if sequence else None

    def out_of_order(self, field: Any) -> OutOfOrder | None:
        """The few samples of `filePath` whose frame numbers break the order of all others."""
        sequence = self.sequence(field)
        return order.find_out_of_order(sequence) if sequence else None

    def holes(self, field: Any) -> Holes | None:
        """The samples of `filePath` that name nothing between others that name files."""
        sequence = self.sequence(field)
        return holes.find_holes(sequence, self._clips.reaching(field)) if sequence else None

    def absence(self, path: str, authored: str, by: Any | None = None) -> Absence:
        """Why nothing is at an absolute path; `authored` is the text that it comes from.

        `by` is the layer that names it as a layer, which is neither itself nor the stage's.
        """
        return self._absences.of(path, authored, by.realPath if by else None)

    def is_assumed(self, *names: str) -> bool:
        """Whether the configuration takes a file that goes by these names to be there."""
        return self._disk.storage.is_assumed(*names)

    def what_to_write(self, field: Any) -> str:
        """What to do about missing files; where frames of a sequence are there, which ones."""
        return absences.what_to_write(self.sequence(field))

    @fact
    def missing(self, field: Any) -> Affected | None:
        """The missing files of `filePath` but those of which another rule tells why."""
        return absences.unexplained(
            self.paths(field),
            self._missing(field),
            lambda: self.recased(field),
            self._has_packages,
            self.tables.tells,
        )

    @fact
    def _missing(self, field: Any) -> Affected | None:
        return self.paths(field).of(AssetState.MISSING)

    @fact
    def missing_folder(self, field: Any) -> str | None:
        """The missing folder that all missing files of a field lie below, or None."""
        missing = self.missing(field)
        return self._absences.common_folder(missing) if missing else None

    def alike(self, field: Any) -> str | None:
        """A key that the fields of a prim share which name the same files; None for one alone."""
        return self._namesakes.key(field)

    def malformed(self, field: Any) -> Iterator[Malformed]:
        """The samples of `filePath` that not every platform reads alike."""
        return malformed.malformed(self.paths(field))

    def frames(self, found: Affected) -> list[tuple[int, str]]:
        """The frame numbers and paths of the files that a path with a placeholder stands for."""
        return corrections.find_frames(self._disk, found.place, found.first.path)

    @fact
    def recased(self, field: Any) -> Recased | None:
        """The samples of `filePath` that differ by case from the names on disk."""
        return letter_case.recased(self.paths(field), self._missing(field), self._disk)

    def outside_package(self, field: Any) -> Affected | None:
        """The samples of `filePath` authored in a package whose files lie outside it."""
        return origins.outside_package(self.paths(field)) if self._has_packages else None

    def unselected_path(self, field: Any) -> VariantPath | None:
        """A variant that is not selected, and that names a file for the field."""
        return in_variants.unselected_path(field)

    def empty_clip(self, field: Any) -> EmptyClip | None:
        """A clip that has the prim that it is asked for, but no samples of `filePath`."""
        return animation.empty_clip(self.paths(field).attribute, self._clips.reaching(field))

    def still(self, field: Any, time_range: tuple[float, float] | None) -> Still | None:
        """The file of a sequence on disk that `filePath` names at all times.

        None also where it hides its own animation, which `Prims.hidden_animation` tells.
        """
        sequence = self.sequence(field)
        if sequence and sequence.is_animated:
            return None  # nearly always
        clips = self._clips.reaching(field)
        paths = self.paths(field)
        found = stillness.find_still(paths, self._families, lambda: self._packs, clips, time_range)
        return None if found and hidden.hidden_animation(paths.attribute, clips) else found

    @cached_property
    def _families(self) -> Families:
        return families.Families(self._disk)

    @cached_property
    def _packs(self) -> Packs:
        """The files that all fields show, which few stages need to know."""
        return stillness.Packs(paths for _, paths in self.paths.readable(schema.FIELD_ASSET))

    @cached_property
    def _absences(self) -> Absences:
        return absences.Absences(self._disk, self._stage.GetRootLayer().realPath)

    @cached_property
    def _namesakes(self) -> Namesakes:
        return alike.Namesakes(self.paths.readable(schema.FIELD_ASSET))

    @cached_property
    def _reader(self) -> AssetReader:
        return classify.AssetReader(self._disk, self._advance)

    @cached_property
    def _marks(self) -> PathMarks:
        return marks.PathMarks(
            self._disk,
            has_packages=self._has_packages,
            has_range=self._has_range or self._stage.HasAuthoredTimeCodeRange(),
        )

    @cached_property
    def _has_packages(self) -> bool:
        """Whether any layer lies in a package."""
        return any(map(origins.package_of, self._stage.GetUsedLayers()))
