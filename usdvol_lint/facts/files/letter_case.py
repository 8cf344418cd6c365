"""Paths that differ by case from the names that the folders hold."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import NamedTuple

from pxr import Ar

from usdvol_lint.facts.files.assets import Affected, AssetSample, AssetSamples
from usdvol_lint.facts.files.corrections import correct_case
from usdvol_lint.facts.files.disk import Disk
from usdvol_lint.facts.files.origins import SampleLayers
from usdvol_lint.facts.files.paths import count_names, split_path
from usdvol_lint.facts.files.states import ON_DISK


class Recased(NamedTuple):
    """Samples whose paths differ by case from what the folders hold; `path` corrects the first."""

    affected: Affected
    path: str


def recased(paths: AssetSamples, disk: Disk) -> Recased | None:
    """The samples whose file, or a folder above it, has its name in another case.

    What resolves is looked at only where the file system ignores case.
    """
    folders = _Folders(paths, disk)
    affected = paths.affected(filter(folders.have_in_another_case, paths.samples))
    if affected is None:
        return None
    path = correct_case(disk, folders.place(affected.first), affected.first.path)
    return Recased(affected, path or affected.first.path)


class _Folder(NamedTuple):
    """The names in a folder, as `Files.names` has them; those in a package begin with `prefix`.

    `differs` says whether the folder's own path has another case.
    """

    names: Mapping[str, str]
    prefix: str
    differs: bool


class _Folders:
    """The folders that samples lead to, each looked at once, however many samples there are."""

    def __init__(self, paths: AssetSamples, disk: Disk) -> None:
        self._paths = paths
        self._disk = disk
        self._layers = SampleLayers(paths)
        self._known: dict[tuple[str, str, float | None], _Folder | None] = {}

    def have_in_another_case(self, sample: AssetSample) -> bool:
        """Whether a file is there, or would be, under another case of the path."""
        if sample.state not in ON_DISK:
            return False
        head, name = split_path(sample.path)
        key = (head, sample.resolved.rpartition("/")[0], self._layers.key(sample))
        if key not in self._known:
            self._known[key] = self._look(sample, head)
        folder = self._known[key]
        if folder is None:
            return False
        name = folder.prefix + name
        there = folder.names.get(name) or folder.names.get(name.lower())
        return there is not None and (folder.differs or there != name)

    def place(self, sample: AssetSample) -> str:
        """The absolute path of a sample."""
        return sample.resolved or self._paths.anchored(sample)

    def _look(self, sample: AssetSample, head: str) -> _Folder | None:
        if sample.resolved and not self._disk.ignores_case(sample.resolved):
            return None
        place = self.place(sample)
        if Ar.IsPackageRelativePath(place):
            package, inner = Ar.SplitPackageRelativePathOuter(place)
            folder, slash, _ = inner.rpartition("/")
            return _Folder(self._disk.names(package), folder + slash, differs=False)
        folder = os.path.dirname(place)
        there = self._disk.in_case(folder, count_names(head))
        return _Folder(self._disk.names(there), "", there != folder) if there else None
