"""The layers and packages that samples are authored in, and how their files lie to these."""

from __future__ import annotations

from typing import Any

from pxr import Ar

from usdvol_lint.cached import cached_property
from usdvol_lint.facts.files.assets import Affected, AssetSample, AssetSamples
from usdvol_lint.facts.files.states import ON_DISK
from usdvol_lint.facts.usd.opinions import is_from_clips, strongest_opinion


def outside_package(paths: AssetSamples) -> Affected | None:
    """The samples authored in a package, or on a stage that is one, whose files lie outside it."""
    layers = SampleLayers(paths)
    root = package_of(paths.attribute.GetStage().GetRootLayer())
    return paths.affected(
        sample
        for sample in paths.samples
        if sample.state in ON_DISK
        and (package := package_of(layers.of(sample)) or root)
        and not _is_in(package, sample.resolved or paths.anchored(sample))
    )


def package_of(layer: Any | None) -> str:
    """The path of the package that a layer lies in, or is the root of; empty if there is none."""
    if layer is None:
        return ""
    path = str(layer.realPath)
    if Ar.IsPackageRelativePath(path):
        return str(Ar.SplitPackageRelativePathOuter(path)[0])
    return path if layer.GetFileFormat().IsPackage() else ""


def _is_in(package: str, path: str) -> bool:
    return path.startswith(f"{package}[") and not path.startswith(f"{package}[../")


class SampleLayers:
    """The layers that hold the samples: one for all time samples, unless they come from clips."""

    def __init__(self, paths: AssetSamples) -> None:
        self._paths = paths
        self._known: dict[float | None, Any | None] = {}

    def of(self, sample: AssetSample) -> Any | None:
        """The layer that holds a sample."""
        time = self.key(sample)
        if time not in self._known:
            strongest = strongest_opinion(self._paths.attribute, time)
            self._known[time] = strongest.spec.layer if strongest else None
        return self._known[time]

    def key(self, sample: AssetSample) -> float | None:
        """A time that stands for all samples in the layer of this one."""
        return sample.time if sample.time is None or self._from_clips else self._last

    @cached_property
    def _last(self) -> float | None:
        return self._paths.samples[-1].time

    @cached_property
    def _from_clips(self) -> bool:
        return is_from_clips(self._paths.attribute, self._last)
