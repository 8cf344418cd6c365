"""Where paths lead: below their layer, out of a package, to a name in another case."""

from __future__ import annotations

import os
from collections.abc import Mapping
from functools import cached_property
from typing import Any, NamedTuple

from pxr import Ar

from usdvol_lint.facts.files.assets import Affected, AssetSamples, Sample
from usdvol_lint.facts.files.disk import Disk
from usdvol_lint.facts.files.states import AssetState
from usdvol_lint.facts.usd.opinions import is_from_clips, strongest_opinion

_THERE = frozenset({AssetState.FILE, AssetState.NOT_A_FILE})
_HERE = _THERE | {AssetState.MISSING}


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
    path = disk.recased(folders.place(affected.first), affected.first.path)
    return Recased(affected, path or affected.first.path)


def outside_package(paths: AssetSamples) -> Affected | None:
    """The samples in a package, or in layers of a stage that is one, whose files lie outside it."""
    layers = _Layers(paths)
    root = package_of(paths.attribute.GetStage().GetRootLayer())
    return paths.affected(
        sample
        for sample in paths.samples
        if sample.state in _HERE
        and (package := package_of(layers.of(sample)) or root)
        and not _is_in(package, sample.resolved or paths.anchored(sample))
    )


def package_of(layer: Any | None) -> str:
    """The package on disk that a layer is in, or is the root of; empty where there is none."""
    if layer is None:
        return ""
    path = str(layer.realPath)
    if Ar.IsPackageRelativePath(path):
        return str(Ar.SplitPackageRelativePathOuter(path)[0])
    return path if layer.GetFileFormat().IsPackage() else ""


def below_layer(affected: Affected) -> str | None:
    """The first path in relation to the folder of the layer that holds it, if it lies below it."""
    held = strongest_opinion(affected.attribute, affected.first.time)
    folder = os.path.dirname(held.spec.layer.realPath) if held else ""
    below = affected.first.path.removeprefix(f"{folder}/")
    return f"./{below}" if folder and below != affected.first.path else None


def _is_in(package: str, path: str) -> bool:
    return path.startswith(f"{package}[") and not path.startswith(f"{package}[../")


class _Layers:
    """The layers that hold samples: one for all time samples, unless they come from clips."""

    def __init__(self, paths: AssetSamples) -> None:
        self._paths = paths
        self._known: dict[float | None, Any | None] = {}

    def of(self, sample: Sample) -> Any | None:
        """The layer that holds a sample."""
        time = self.key(sample)
        if time not in self._known:
            held = strongest_opinion(self._paths.attribute, time)
            self._known[time] = held.spec.layer if held else None
        return self._known[time]

    def key(self, sample: Sample) -> float | None:
        """A time at which the layer is that of the sample, the same for many samples."""
        return sample.time if sample.time is None or self._from_clips else self._last

    @cached_property
    def _last(self) -> float | None:
        return self._paths.samples[-1].time

    @cached_property
    def _from_clips(self) -> bool:
        return is_from_clips(self._paths.attribute, self._last)


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
        self._layers = _Layers(paths)
        self._known: dict[tuple[str, str, float | None], _Folder | None] = {}

    def have_in_another_case(self, sample: Sample) -> bool:
        """Whether a file is there, or would be, under another case of the path."""
        if sample.state not in _HERE:
            return False
        head, _, name = sample.path.partition(":SDF_FORMAT_ARGS:")[0].rpartition("/")
        key = (head, sample.resolved.rpartition("/")[0], self._layers.key(sample))
        if key not in self._known:
            self._known[key] = self._look(sample, head)
        folder = self._known[key]
        if folder is None:
            return False
        name = folder.prefix + name
        there = folder.names.get(name) or folder.names.get(name.lower())
        return there is not None and (folder.differs or there != name)

    def place(self, sample: Sample) -> str:
        """The absolute path of a sample."""
        return sample.resolved or self._paths.anchored(sample)

    def _look(self, sample: Sample, head: str) -> _Folder | None:
        if sample.resolved and not self._disk.ignores_case(sample.resolved):
            return None
        place = self.place(sample)
        if Ar.IsPackageRelativePath(place):
            package, inner = Ar.SplitPackageRelativePathOuter(place)
            folder, slash, _ = inner.rpartition("/")
            return _Folder(self._disk.names(package), folder + slash, differs=False)
        folder = os.path.dirname(place)
        there = self._disk.in_case(folder, head)
        return _Folder(self._disk.names(there), "", there != folder) if there else None
