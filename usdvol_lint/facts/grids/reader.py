"""Reads the files that the fields of a stage name, each path once."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from typing import Any

from pxr import Ar

from usdvol_lint.facts.files.assets import AssetSample, AssetSamples
from usdvol_lint.facts.files.paths import is_packaged
from usdvol_lint.facts.files.states import AssetState
from usdvol_lint.facts.grids.claims import Claim, FieldClaims
from usdvol_lint.facts.grids.contents import Content, ContentClass
from usdvol_lint.facts.grids.known import KnownContents
from usdvol_lint.facts.grids.timelines import Timeline
from usdvol_lint.facts.prims.attributes import Authored
from usdvol_lint.facts.usd.diagnostics import UNREADABLE
from usdvol_lint.facts.usd.steps import StepSamples, Time
from usdvol_lint.volumefile.cache import Reading
from usdvol_lint.volumefile.model import Fault, Format

_FORMATS: dict[str, Format] = {"OpenVDBAsset": "openvdb", "Field3DAsset": "field3d"}
_READ_TOGETHER = 1024
_NOTHING = Timeline((), 0)


class ContentReader:
    """Reads the files of the fields of a stage."""

    def __init__(self, known: KnownContents, depth: str, advance: Callable[[int], None]) -> None:
        """`depth` is how many of a field's files are read: all, first or off.

        `advance` is told how many files were read since its last call.
        """
        self._files = known.files
        self._depth = depth
        self._advance = advance
        self._formats: dict[frozenset[str], Format | None] = {}
        self._readings: dict[str, Reading] = {}
        self._packages: dict[str, Any] = {}
        self._classes = known.classes
        self._single: dict[tuple[AssetSample, FieldClaims, Format], Timeline] = {}

    def read(
        self,
        samples: Iterable[AssetSamples],
        claims: Iterable[FieldClaims],
        authored: Authored,
    ) -> list[Timeline]:
        """The contents of each field's files; `authored` is what all the fields share.

        `samples` are the values of their `filePath`.
        """
        wanted = self._wanted(authored.schemas)
        if not wanted or self._depth == "off":
            return [_NOTHING for _ in samples]
        return [self._contents(*each, wanted) for each in zip(samples, claims, strict=True)]

    def _contents(self, samples: AssetSamples, claims: FieldClaims, wanted: Format) -> Timeline:
        if AssetState.FILE not in samples.states:
            return _NOTHING
        if len(samples.samples) > 1:
            return self._read(samples, claims, wanted)
        key = (samples.samples[0], claims, wanted)
        found = self._single.get(key)
        if found is None:
            found = self._single[key] = self._read(samples, claims, wanted)
        return found

    def _read(self, samples: AssetSamples, claims: FieldClaims, wanted: Format) -> Timeline:
        classes: dict[ContentClass, list[Content]] = {}
        total = read = 0
        for sample, claim in _with_claims(samples, claims):
            total += sample.time is not None
            if sample.state is AssetState.FILE:
                content = Content(sample, claim, self._reading(sample.resolved), wanted)
                classes.setdefault(self._class_of(content), []).append(content)
                read += 1
                if self._depth == "first":
                    total = int(sample.time is not None)
                    break
                if read % _READ_TOGETHER == 0:
                    self._advance(_READ_TOGETHER)
        return Timeline(tuple(classes.items()), total)

    def _wanted(self, schemas: frozenset[str]) -> Format | None:
        """The file format that fields of these schemas ask for, or None."""
        if schemas not in self._formats:
            named = (format for name, format in _FORMATS.items() if name in schemas)
            self._formats[schemas] = next(named, None)
        return self._formats[schemas]

    def _class_of(self, content: Content) -> ContentClass:
        _, claim, reading, wanted = content
        formats = (wanted, content.unexpected_format, content.swapped_format)
        key = (claim, reading.layout, formats)
        found = self._classes.get(key)
        if found is None:
            found = self._classes[key] = ContentClass(content)
        return found

    def _reading(self, resolved: str) -> Reading:
        reading = self._readings.get(resolved)
        if reading is None:
            reading = self._readings[resolved] = self._read_safely(resolved)
        return reading

    def _read_safely(self, resolved: str) -> Reading:
        """What is read of a file: whatever its bytes are, the other files of the stage are read."""
        try:
            return self._read_file(resolved)
        except UNREADABLE:
            raise  # USD's own, which the engine tells
        except Exception as error:
            said = " ".join(f"{type(error).__name__}: {error}".split())
            return _unread(f"reading it failed, {said:.200}")

    def _read_file(self, resolved: str) -> Reading:
        if is_packaged(resolved):
            return self._read_packaged(*Ar.SplitPackageRelativePathOuter(resolved))
        if os.path.isabs(resolved):
            return self._files.read(resolved)
        return _unread("it is no file on disk")

    def _read_packaged(self, package: str, inner: str) -> Reading:
        from usdvol_lint.volumefile.package import NotInPlaceError, Package

        if package not in self._packages:
            self._packages[package] = Package(package)
        try:
            offset, size = self._packages[package].locate(inner)
        except NotInPlaceError as error:
            return _unread(f"it {error}")
        return self._files.read(package, offset, size)


def _with_claims(samples: AssetSamples, claims: FieldClaims) -> Iterator[tuple[AssetSample, Claim]]:
    """The samples with their claims; a sample recurs at each time at which the claim changes."""
    if not claims.times:
        for sample in samples.samples:
            yield sample, claims.default
        return
    files = StepSamples((sample.time, sample) for sample in samples.samples)
    default: list[Time] = [None] if files.default else []
    for time in (*default, *sorted({*files.times, *claims.times})):
        if shown := files.at(time):
            yield shown._replace(time=time), claims.at(time)


def _unread(reason: str) -> Reading:
    fault = Fault("not-in-place", reason)
    return Reading(None, fault, fault)
