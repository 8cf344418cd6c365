"""Properties of an asset attribute's values that preconditions of rules look at."""

from __future__ import annotations

import re
from collections.abc import Iterable
from enum import Enum

from usdvol_lint.facts.files.assets import AssetSample, AssetSamples
from usdvol_lint.facts.files.disk import Disk
from usdvol_lint.facts.files.states import AssetState, PathMark
from usdvol_lint.facts.prims.attributes import Authored
from usdvol_lint.schema import FILE_EXTENSIONS

_NUMBERED = re.compile(r"[0-9]{3}\.[A-Za-z]\w*\]?$")
_UNPLAIN = re.compile(r"(?s)/|.*[\\:~\s]")


class PathMarks:
    """Finds the marks of the fields of a stage; fields that name the same one file share theirs.

    `has_packages` is whether any layer of the stage lies in a package, `has_range` whether the
    stage has a time range.
    """

    def __init__(self, disk: Disk, *, has_packages: bool, has_range: bool) -> None:
        self._disk = disk
        self._has_packages = has_packages
        self._has_range = has_range
        self._known: dict[tuple[str, str, Authored], frozenset[Enum]] = {}

    def of(self, paths: Iterable[AssetSamples], authored: Authored) -> list[frozenset[Enum]]:
        """The states and marks of each prim's values; `authored` is what all the prims share."""
        return [self._of(each, authored) for each in paths]

    def _of(self, paths: AssetSamples, authored: Authored) -> frozenset[Enum]:
        samples = paths.samples
        if len(samples) != 1 or samples[0].state is not AssetState.FILE:
            return self._find(paths, authored)
        key = (samples[0].path, samples[0].resolved, authored)
        found = self._known.get(key)
        if found is None:
            found = self._known[key] = self._find(paths, authored)
        return found

    def _find(self, paths: AssetSamples, authored: Authored) -> frozenset[Enum]:
        found: set[Enum] = set(paths.states)
        if not paths.names_a_path:
            found.add(PathMark.NONE)
        if len(paths.samples) > 1:
            found.add(PathMark.SEVERAL)
        extensions = (end for name, end in FILE_EXTENSIONS.items() if name in authored.schemas)
        extension = next(extensions, "")
        if any(not (each.resolved or each.path).endswith(extension) for each in paths.samples):
            found.add(PathMark.FOREIGN)
        if self._has_range and len(paths.samples) == 1 and _NUMBERED.search(paths.samples[0].path):
            found.add(PathMark.NUMBERED)
        if any(map(_UNPLAIN.match, (sample.path for sample in paths.samples))):
            found.add(PathMark.UNPLAIN)
        if self._has_packages:
            found.add(PathMark.PACKAGED)
        if self._may_differ_in_case(paths):
            found.add(PathMark.CASE_BLIND)
        return frozenset(found)

    def _may_differ_in_case(self, paths: AssetSamples) -> bool:
        if AssetState.MISSING in paths.states:
            return True
        folders: dict[str, AssetSample] = {}
        for sample in paths.samples:
            folders.setdefault(sample.resolved.rpartition("/")[0], sample)
        resolved = (sample.resolved for sample in folders.values() if sample.resolved)
        return any(map(self._disk.ignores_case, resolved))
