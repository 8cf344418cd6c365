"""What is inside the files that a field names, held against what the field says of it."""

from __future__ import annotations

import os
from collections import defaultdict
from collections.abc import Callable, Container, Hashable, Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

from pxr import Ar

from usdvol_lint.facts.assets import Affected, AssetSamples, Sample
from usdvol_lint.facts.files import is_packaged
from usdvol_lint.facts.held import Held, Time
from usdvol_lint.facts.states import AssetState
from usdvol_lint.facts.values import read_values
from usdvol_lint.volumefile import tokens
from usdvol_lint.volumefile.cache import Fault, Reading, VolumeFiles
from usdvol_lint.volumefile.model import Format, Grid, VolumeFile, quoted

FORMATS: dict[str, Format] = {"OpenVDBAsset": "openvdb", "Field3DAsset": "field3d"}
_READ_TOGETHER = 1024
_NAMES = 8
_UNREAD = ("needs-h5py", "not-in-place")


@dataclass(frozen=True, slots=True)
class Claim:
    """What a field says at one time of what it wants from its file; empty where it says nothing."""

    name: str = ""
    purpose: str = ""
    index: int | None = None
    data_type: str = ""
    field_class: str = ""
    role_hint: str = ""


_ATTRIBUTES = {
    "fieldName": "name",
    "fieldPurpose": "purpose",
    "fieldIndex": "index",
    "fieldDataType": "data_type",
    "fieldClass": "field_class",
    "vectorDataRoleHint": "role_hint",
}


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
    def unread(self) -> str | None:
        """Why a file was not looked into, in words."""
        fault = self.reading.fault
        return fault.message if fault and fault.code in _UNREAD else None

    @property
    def stranger(self) -> Format | None:
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
        return self.reading.file if sound and not self.stranger else None

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
    def data_types(self) -> tuple[str, ...]:
        """The data types that fit the grid, the best one first."""
        return tokens.data_types(self.grid.value_type, self.grid.half) if self.grid else ()

    @property
    def field_class(self) -> str:
        """The class of the grid; unknown where it says none, or its format has none."""
        return tokens.field_class(self.grid.grid_class) if self.grid else "unknown"

    @property
    def role_hints(self) -> tuple[str, ...]:
        """The roles that fit the grid's vectors; none where it tells nothing of them for sure."""
        grid = self.grid
        if grid is None or not grid.value_type.startswith("vec"):
            return ()
        hints = tokens.role_hints(grid.vector_type)
        return hints.fitting if hints.strength == "strong" else ()


@dataclass(frozen=True)
class FieldContents:
    """The contents of all files that a field names, in ascending time, the default first.

    `total` is at how many times it was looked for them.
    """

    attribute: Any
    contents: tuple[Content, ...]
    total: int

    def grouped(
        self, key: Callable[[Content], Hashable | None]
    ) -> Iterator[tuple[Content, Affected]]:
        """The first content and all samples of each key that the contents have, None aside.

        The key is asked for once among contents of one kind: it can't depend on bounds,
        transforms and the numbers in messages, nor on the sample.
        """
        found: dict[Hashable, list[list[Content]]] = defaultdict(list)
        for contents in self._kinds:
            value = key(contents[0])
            if value is not None:
                found[value].append(contents)
        for groups in found.values():
            together = [content for contents in groups for content in contents]
            if len(groups) > 1:
                together.sort(key=_order)
            samples = tuple(content.sample for content in together)
            yield together[0], Affected(self.attribute, samples, self.total)

    def grids(self) -> Iterator[tuple[float | None, Grid | None]]:
        """The grid that name and index select, at each time."""
        for contents in self._kinds:
            first = contents[0]
            chosen = first.grid
            place = first.file.grids.index(chosen) if first.file and chosen else 0
            for sample, _, reading, _ in contents:
                yield sample.time, reading.file.grids[place] if chosen and reading.file else None

    @property
    def single_grid(self) -> bool:
        """Whether files were looked into, and each holds exactly one grid."""
        files = [contents[0].file for contents in self._kinds]
        return bool(files) and all(
            file is not None and file.complete and len(file.grids) == 1 for file in files
        )

    @property
    def differ(self) -> bool:
        """Whether the contents are of several kinds."""
        return len(self._kinds) > 1

    @cached_property
    def files(self) -> tuple[tuple[float | None, str], ...]:
        """The files and when they are named, which fields may share."""
        return tuple((sample.time, sample.resolved) for sample, *_ in self.contents)

    @cached_property
    def _kinds(self) -> list[list[Content]]:
        kinds: dict[Hashable, list[Content]] = defaultdict(list)
        for content in self.contents:
            kinds[content.claim, content.reading.kind, content.stranger].append(content)
        return list(kinds.values())


class ContentReader:
    """Reads the files of a stage's fields, each once."""

    def __init__(self, files: VolumeFiles, extent: str, advance: Callable[[int], None]) -> None:
        """`extent` is how many of a field's files are read: all, first or off."""
        self._files = files
        self._extent = extent
        self._advance = advance
        self._readings: dict[str, Reading] = {}
        self._packages: dict[str, Any] = {}

    def read(
        self, field: Any, samples: AssetSamples, schemas: Iterable[str], authored: Container[str]
    ) -> FieldContents:
        """The contents of the files in the samples of a field's `filePath`.

        `schemas` are those that the field answers to; `authored` has the names of its attributes.
        """
        wanted = next((FORMATS[name] for name in schemas if name in FORMATS), None)
        if not wanted or self._extent == "off" or AssetState.FILE not in samples.states:
            return FieldContents(samples.attribute, (), 0)
        contents: list[Content] = []
        total = 0
        for sample, claim in _moments(samples, _claims(field, authored)):
            total += sample.time is not None
            if sample.state is AssetState.FILE:
                contents.append(Content(sample, claim, self._reading(sample.resolved), wanted))
                if self._extent == "first":
                    total = 1 if sample.time is not None else 0
                    break
                if len(contents) % _READ_TOGETHER == 0:
                    self._advance(_READ_TOGETHER)
        return FieldContents(samples.attribute, tuple(contents), total)

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
        from usdvol_lint.volumefile.package import (
            NotInPlaceError,
            Package,
        )  # few stages are packages

        if package not in self._packages:
            self._packages[package] = Package(package)
        try:
            offset, size = self._packages[package].locate(inner)
        except NotInPlaceError as error:
            return _unread(f"it {error}")
        return self._files.read(package, offset, size)


def _shown(grid: Grid) -> str:
    if not (grid.name or grid.unique_name):
        return "an unnamed grid"
    return quoted(f"{grid.purpose}:{grid.label}" if grid.purpose else grid.label)


def _unread(reason: str) -> Reading:
    fault = Fault("not-in-place", reason)
    return Reading(None, fault, fault)


def _claims(field: Any, authored: Container[str]) -> dict[str, Held[Any]]:
    """What the field says of its content, by the names in `Claim`."""
    found = {}
    for name, short in _ATTRIBUTES.items():
        if name in authored:
            kind = int if short == "index" else str
            values = read_values(field.GetAttribute(name))
            found[short] = Held((time, value) for time, value in values if isinstance(value, kind))
    return found


def _moments(samples: AssetSamples, claims: dict[str, Held[Any]]) -> Iterator[tuple[Sample, Claim]]:
    """The samples of a file path, and those at times when what the field says of it changes."""
    if not any(held.times for held in claims.values()):
        claim = _claim({name: held.default for name, held in claims.items()})
        for sample in samples.samples:
            yield sample, claim
        return
    files = Held((sample.time, sample) for sample in samples.samples)
    times = {time for held in (files, *claims.values()) for time in held.times}
    moments: list[Time] = [*([None] if files.default else []), *sorted(times)]
    for time in moments:
        if held_file := files.at(time):
            said = {name: held.at(time) for name, held in claims.items()}
            yield held_file._replace(time=time), _claim(said)


def _claim(said: dict[str, Any]) -> Claim:
    return Claim(**{name: value for name, value in said.items() if value is not None})


def _order(content: Content) -> tuple[bool, float]:
    time = content.sample.time
    return time is not None, time or 0.0
