"""Paths that differ from the names on disk in nothing but case."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import NamedTuple

from pxr import Ar

from usdvol_lint.facts.files.assets import Affected, AssetSample, AssetSamples
from usdvol_lint.facts.files.corrections import correct_case
from usdvol_lint.facts.files.disk import Disk
from usdvol_lint.facts.files.origins import SampleLayers
from usdvol_lint.facts.files.paths import count_shared, is_packaged, split_path
from usdvol_lint.facts.files.states import ON_DISK


class Recased(NamedTuple):
    """Samples whose paths differ by case from the names on disk; `path` corrects the first."""

    affected: Affected
    path: str


def recased(paths: AssetSamples, missing: Affected | None, disk: Disk) -> Recased | None:
    """The samples whose file, or a folder that they name, has another case on disk.

    `missing` are those of them at whose path nothing is.

    Paths that resolve are looked at only where the file system ignores case.
    """
    if missing and len(paths.samples) == 1 and not is_packaged(missing.place):
        authored, _ = split_path(missing.first.path)
        if not disk.has_folder(os.path.dirname(missing.place), authored):
            return None  # as for many files that lie in one
    folders = _Folders(paths, missing, disk)
    affected = paths.affected(filter(folders.have_another_case, paths.samples))
    if affected is None:
        return None
    path = correct_case(disk, folders.absolute(affected.first), affected.first.path)
    return Recased(affected, path or affected.first.path)


class _Folder(NamedTuple):
    """What is in a folder, as `Listing.by_case` gives it; names in a package begin with `prefix`.

    `differs` is whether the folder's own path has another case on disk.
    """

    names: Mapping[str, str]
    prefix: str
    differs: bool


class _Folders:
    """The folders of the samples' files, each looked at once, however many samples there are."""

    def __init__(self, paths: AssetSamples, missing: Affected | None, disk: Disk) -> None:
        self._paths = paths
        self._missing = missing
        self._disk = disk
        self._layers = SampleLayers(paths)
        self._known: dict[tuple[str, str, float | None], _Folder | None] = {}

    def have_another_case(self, sample: AssetSample) -> bool:
        """Whether there is a file whose path differs from the sample's in nothing but case."""
        if sample.state not in ON_DISK:
            return False
        folder_path, name = split_path(sample.path)
        key = (folder_path, sample.resolved.rpartition("/")[0], self._layers.key(sample))
        if key not in self._known:
            self._known[key] = self._look(sample, folder_path)
        folder = self._known[key]
        if folder is None:
            return False
        name = folder.prefix + name
        actual = folder.names.get(name) or folder.names.get(name.lower())
        return actual is not None and (folder.differs or actual != name)

    def absolute(self, sample: AssetSample) -> str:
        """The absolute path of a sample."""
        if self._missing and sample is self._missing.first:
            return self._missing.place  # which whoever tells of it asks for too
        return sample.resolved or self._paths.anchored(sample)

    def _look(self, sample: AssetSample, folder_path: str) -> _Folder | None:
        """The folder of a sample, `folder_path` in its path; None where no case can differ."""
        if sample.resolved and not self._disk.ignores_case(sample.resolved):
            return None
        path = self.absolute(sample)
        if Ar.IsPackageRelativePath(path):
            package, inner = Ar.SplitPackageRelativePathOuter(path)
            folder, slash, _ = inner.rpartition("/")
            return _Folder(self._disk.listing(package).by_case, folder + slash, differs=False)
        folder = os.path.dirname(path)
        actual = self._disk.in_case(folder, count_shared(folder_path, folder))
        return _Folder(self._disk.listing(actual).by_case, "", actual != folder) if actual else None
