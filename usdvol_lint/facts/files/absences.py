"""The folder that is missing above all missing files of a field."""

from __future__ import annotations

from usdvol_lint.facts.files.assets import AssetSamples
from usdvol_lint.facts.files.corrections import missing_folder
from usdvol_lint.facts.files.disk import Disk
from usdvol_lint.facts.files.paths import split_path
from usdvol_lint.facts.files.states import AssetState


def common_missing_folder(paths: AssetSamples, disk: Disk) -> str | None:
    """The topmost missing folder above all missing files, if their paths have one folder."""
    missing = paths.of(AssetState.MISSING)
    if missing is None:
        return None
    folders = {split_path(sample.path)[0] for sample in missing.samples}
    return missing_folder(disk, missing.anchored()) if len(folders) == 1 else None
