"""What is inside the files that a field names, held against what the field says of it."""

from __future__ import annotations

import os
from collections.abc import Callable, Hashable, Iterable, Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple, TypeVar

from pxr import Ar

from usdvol_lint.facts.files.assets import Affected, AssetSamples, Sample
from usdvol_lint.facts.files.disk import is_packaged
from usdvol_lint.facts.files.states import AssetState
from usdvol_lint.facts.grids.claims import Claim, FieldClaims
from usdvol_lint.facts.prims.attributes import Authored
from usdvol_lint.facts.usd.steps import StepSamples, Time
from usdvol_lint.volumefile import tokens
from usdvol_lint.volumefile.cache import Reading, VolumeFiles
from usdvol_lint.volumefile.model import Fault, Format, Grid, VolumeFile, quoted

_FORMATS: dict[str, Format] = {"OpenVDBAsset": "openvdb", "Field3DAsset": "field3d"}
_READ_TOGETHER = 1024
_NAMES = 8
_UNREAD = ("needs-h5py", "not-in-place")


class Content(NamedTuple):
    """The content of one sample's file, and what the field says of it at that time.

    `wanted` is the format of files that the field's schema asks for.
    """

    sample: Sample
    claim: Claim
    reading: Reading
    wanted: Format

    @property
    def fault(self) -> Fault | None:
        """What is wrong with a file that was read."""
        return None if self.unread else self.reading.fault

    @property
    def fault_message(self) -> str:
        """The same in words; empty where nothing is wrong."""
        return self.fault.message if self.fault else ""

    @property
    def unread(self) -> str | None:
        """Why a file was not looked into, in words."""
        fault = self.reading.fault
        return fault.message if fault and fault.code in _UNREAD else None

    @property
    def unexpected_format(self) -> Format | None:
        """The format of the file if it is another than its extension or the schema lets expect.

        A NanoVDB file with an extension of its own is not the schema's, but read by some.
        """
        file = self.reading.file
        if file is None or file.format == self.wanted:
            return None
        extension = os.path.splitext(self.sample.resolved.rstrip("]"))[1].lower()
        told = {".nvdb": "nanovdb", ".vdb": "openvdb", ".f3d": "field3d"}.get(extension)
        return None if told == file.format else file.format

    @property
    def file(self) -> VolumeFile | None:
        """What can be relied on: of a truncated file as much as is there."""
        fault = self.reading.fault
        sound = fault is None or fault.code == "truncated"
        return self.reading.file if sound and not self.unexpected_format else None

    @property
    def grids(self) -> tuple[Grid, ...]:
        """The grids of the field's name, in the order of the file.

        Where the field gives no name, the only grid is meant.
        """
        file, name, purpose = self.file, self.claim.name, self.claim.purpose
        if file is None:
            return ()
        grids = file.grids
        if purpose and file.format == "field3d":
            grids = tuple(grid for grid in grids if grid.purpose == purpose)
        if not name:
            return grids if file.complete and len(grids) == 1 else ()
        found = (
            tuple(grid for grid in grids if getattr(grid, attribute) == name)
            for attribute in ("unique_name", "label", "name")
        )
        return next(filter(None, found), ())

    @property
    def holds(self) -> str:
        """What the file holds, in words that follow `holds`."""
        shown = [_shown(grid) for grid in self.file.grids] if self.file else []
        if len(shown) > _NAMES:
            shown[_NAMES - 1 :] = [f"{len(shown) - _NAMES + 1} more"]
        return ", ".join(shown) if shown else "no grids"

    @property
    def grid(self) -> Grid | None:
        """The grid that name and index select, the first where there is no index."""
        index = self.claim.index or 0
        grids = self.grids
        return grids[index] if 0 <= index < len(grids) else None

    @property
    def grid_names(self) -> frozenset[str]:
        """The names of the grids in the file, as far as they can be relied on."""
        return frozenset(grid.unique_name for grid in self.file.grids) if self.file else frozenset()

    @property
    def label(self) -> str:
        """The label of the grid that is selected, in quotes; empty where there is none."""
        return quoted(self.grid.label) if self.grid else ""

    @property
    def data_types(self) -> tuple[str, ...]:
        """The data types that fit the grid, the best one first."""
        return tokens.data_types(self.grid.value_type, self.grid.half) if self.grid else ()

    @property
    def field_class(self) -> str:
        """The class of the grid; unknown where it says none, or its format has none."""
        return tokens.field_class(self.grid.grid_class) if self.grid else "unknown"

    @property
    def written_class(self) -> str:
        """The same as the file has it."""
        return self.grid.grid_class if self.grid else ""

    @property
    def role_hints(self) -> tuple[str, ...]:
        """The roles that fit the grid's vectors; none where it tells nothing of them for sure."""
        grid = self.grid
        if grid is None or not grid.value_type.startswith("vec"):
            return ()
        hints = tokens.role_hints(grid.vector_type)
        return hints.fitting if hints.strength == "strong" else ()


_K = TypeVar("_K", bound=Hashable)


class Kind:
    """What contents have in common that a rule says the same of; `content` is the first of them.

    It is shared by all fields of a stage, so a rule makes up its mind once.
    """

    __slots__ = ("_answers", "content")

    def __init__(self, content: Content) -> None:
        self.content = content
        self._answers: dict[Hashable, Any] = {}

    def answer(self, key: Callable[[Content], _K | None]) -> _K | None:
        """What a rule asks of these contents; `key` is known again if it is equal to itself."""
        answers = self._answers
        if key not in answers:
            answers[key] = key(self.content)
        found: _K | None = answers[key]
        return found


@dataclass(frozen=True, slots=True, eq=False)
class Timeline:
    """The contents of all files that a field names, by kind, in ascending time, the default first.

    `total` is at how many times it was looked for them.  Fields that name the same single file and
    say the same of it share one.
    """

    kinds: tuple[tuple[Kind, list[Content]], ...]
    total: int

    @property
    def contents(self) -> list[Content]:
        return sorted((content for _, contents in self.kinds for content in contents), key=_order)

    def grids(self) -> Iterator[tuple[Time, Grid | None]]:
        """The grid that name and index select, at each time."""
        for kind, contents in self.kinds:
            place: Any = kind.answer(_place_of_grid)
            for sample, _, reading, _ in contents:
                if place is None or reading.file is None:
                    yield sample.time, None
                else:
                    yield sample.time, reading.file.grids[place]

    @property
    def select_grids(self) -> bool:
        """Whether some file was looked into and has the grid that the field names."""
        return any(kind.answer(_place_of_grid) is not None for kind, _ in self.kinds)

    @property
    def have_no_data_type(self) -> bool:
        """Whether the grids were found, and no `fieldDataType` stands for what they hold."""
        contents = [kind.content for kind, _ in self.kinds]
        return bool(contents) and all(
            content.grid is not None and not content.data_types for content in contents
        )

    @property
    def single_grid(self) -> bool:
        """Whether files were looked into, and each holds exactly one grid."""
        files = [kind.content.file for kind, _ in self.kinds]
        return bool(files) and all(
            file is not None and file.complete and len(file.grids) == 1 for file in files
        )

    @property
    def files(self) -> list[tuple[Time, str]]:
        """The files and when they are named, which fields may share."""
        return [(sample.time, sample.resolved) for sample, *_ in self.contents]


_NOTHING = Timeline((), 0)


class FieldContents(NamedTuple):
    """The contents of a field's files, and the attribute that names them."""

    attribute: Any
    all: Timeline

    def grouped(
        self, key: Callable[[Content], _K | None]
    ) -> Iterable[tuple[_K, Content, Affected]]:
        """Each key that the contents have, None aside, with its first content and all samples.

        The key is asked for once among contents of one kind: it can't depend on bounds,
        transforms and the numbers in messages, nor on the sample.
        """
        found: dict[_K, list[list[Content]]] = {}
        for kind, contents in self.all.kinds:
            value = kind.answer(key)
            if value is not None:
                found.setdefault(value, []).append(contents)
        return [(value, *self._affected(groups)) for value, groups in found.items()]

    def _affected(self, groups: list[list[Content]]) -> tuple[Content, Affected]:
        together = [content for contents in groups for content in contents]
        if len(groups) > 1:
            together.sort(key=_order)
        samples = tuple(content.sample for content in together)
        return together[0], Affected(self.attribute, samples, self.all.total)


class ContentReader:
    """Reads the files of a stage's fields, each once."""

    def __init__(self, files: VolumeFiles, extent: str, advance: Callable[[int], None]) -> None:
        """`extent` is how many of a field's files are read: all, first or off."""
        self._files = files
        self._extent = extent
        self._advance = advance
        self._formats: dict[frozenset[str], Format | None] = {}
        self._readings: dict[str, Reading] = {}
        self._packages: dict[str, Any] = {}
        self._kinds: dict[Hashable, Kind] = {}
        self._alone: dict[tuple[Sample, FieldClaims, Format], Timeline] = {}

    def read(
        self,
        samples: Iterable[AssetSamples],
        claims: Iterable[FieldClaims],
        authored: Authored,
    ) -> list[Timeline]:
        """The contents of the files in the samples of `filePath` of many fields that are alike."""
        wanted = self._wanted(authored.schemas)
        if not wanted or self._extent == "off":
            return [_NOTHING for _ in samples]
        return [self._contents(*each, wanted) for each in zip(samples, claims, strict=True)]

    def _contents(self, samples: AssetSamples, claims: FieldClaims, wanted: Format) -> Timeline:
        if AssetState.FILE not in samples.states:
            return _NOTHING
        if len(samples.samples) > 1:
            return self._read(samples, claims, wanted)
        key = (samples.samples[0], claims, wanted)
        found = self._alone.get(key)
        if found is None:
            found = self._alone[key] = self._read(samples, claims, wanted)
        return found

    def _read(self, samples: AssetSamples, claims: FieldClaims, wanted: Format) -> Timeline:
        kinds: dict[Kind, list[Content]] = {}
        total = read = 0
        for sample, claim in _moments(samples, claims):
            total += sample.time is not None
            if sample.state is AssetState.FILE:
                content = Content(sample, claim, self._reading(sample.resolved), wanted)
                kinds.setdefault(self._kind(content), []).append(content)
                read += 1
                if self._extent == "first":
                    total = int(sample.time is not None)
                    break
                if read % _READ_TOGETHER == 0:
                    self._advance(_READ_TOGETHER)
        return Timeline(tuple(kinds.items()), total)

    def _wanted(self, schemas: frozenset[str]) -> Format | None:
        """The format of files that fields of these schemas ask for."""
        if schemas not in self._formats:
            named = (format for name, format in _FORMATS.items() if name in schemas)
            self._formats[schemas] = next(named, None)
        return self._formats[schemas]

    def _kind(self, content: Content) -> Kind:
        _, claim, reading, wanted = content
        key = (claim, reading.layout, wanted, content.unexpected_format)
        kind = self._kinds.get(key)
        if kind is None:
            kind = self._kinds[key] = Kind(content)
        return kind

    def _reading(self, resolved: str) -> Reading:
        reading = self._readings.get(resolved)
        if reading is None:
            if is_packaged(resolved):
                reading = self._read_packaged(*Ar.SplitPackageRelativePathOuter(resolved))
            elif os.path.isabs(resolved):
                reading = self._files.read(resolved)
            else:
                reading = _unread("it is no file on disk")
            self._readings[resolved] = reading
        return reading

    def _read_packaged(self, package: str, inner: str) -> Reading:
        from usdvol_lint.volumefile.package import NotInPlaceError, Package

        if package not in self._packages:
            self._packages[package] = Package(package)
        try:
            offset, size = self._packages[package].locate(inner)
        except NotInPlaceError as error:
            return _unread(f"it {error}")
        return self._files.read(package, offset, size)


def _moments(samples: AssetSamples, claims: FieldClaims) -> Iterator[tuple[Sample, Claim]]:
    """The samples of a file path, and those at times when what the field says changes."""
    if not claims.times:
        for sample in samples.samples:
            yield sample, claims.default
        return
    files = StepSamples((sample.time, sample) for sample in samples.samples)
    moments: list[Time] = [None] if files.default else []
    for time in (*moments, *sorted({*files.times, *claims.times})):
        if held_file := files.at(time):
            yield held_file._replace(time=time), claims.at(time)


def _shown(grid: Grid) -> str:
    if not (grid.name or grid.unique_name):
        return "an unnamed grid"
    return quoted(f"{grid.purpose}:{grid.label}" if grid.purpose else grid.label)


def _place_of_grid(content: Content) -> int | None:
    """Which of the grids in its file a content selects, counted from 0."""
    file, grid = content.file, content.grid
    return file.grids.index(grid) if file and grid else None


def _unread(reason: str) -> Reading:
    fault = Fault("not-in-place", reason)
    return Reading(None, fault, fault)


def _order(content: Content) -> tuple[bool, float]:
    time = content.sample.time
    return time is not None, time or 0.0
