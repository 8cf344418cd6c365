"""The missing files of a field, and the folder that is missing above all of them."""

from __future__ import annotations

from collections.abc import Callable
from itertools import chain
from math import isnan

from usdvol_lint.facts.files.assets import Affected, AssetSamples
from usdvol_lint.facts.files.corrections import Absence, find_absence, missing_folder
from usdvol_lint.facts.files.disk import Disk
from usdvol_lint.facts.files.letter_case import Recased
from usdvol_lint.facts.files.malformed import hides_file
from usdvol_lint.facts.files.origins import outside_package
from usdvol_lint.facts.files.paths import split_path
from usdvol_lint.facts.files.sequences import SampleSequence
from usdvol_lint.facts.files.states import AssetState
from usdvol_lint.words import frame_ranges

_ANY = "write or copy it there, or name a file that is there"


def unexplained(
    paths: AssetSamples,
    missing: Affected | None,
    recased: Callable[[], Recased | None],
    has_packages: bool,
    tells: Callable[[str], bool],
) -> Affected | None:
    """The missing files of paths but those of which another rule tells why they are not found.

    Their paths are malformed, have another case than the disk, or lead out of their package.
    `recased`: asks for the samples of another case; `tells`: as `Tables.tells`.
    """
    if missing is None:
        return None
    in_other_case = recased() if tells("AST009") else None
    outside = outside_package(paths) if has_packages and tells("AST015") else None
    others = (in_other_case and in_other_case.affected, outside)
    explained = set(chain.from_iterable(each.samples for each in others if each))
    if tells("AST008"):
        explained.update(filter(hides_file, missing.samples))
    if not explained:
        return missing
    return paths.affected(sample for sample in missing.samples if sample not in explained)


class Absences:
    """Why nothing is at paths of one stage: found once, however many fields name a path.

    `root` is the layer of the stage.
    """

    def __init__(self, disk: Disk, root: str) -> None:
        self._disk = disk
        self._root = root
        self._found: dict[tuple[str, str, str | None], Absence] = {}
        self._folders: dict[str, str | None] = {}

    def of(self, path: str, authored: str, by: str | None) -> Absence:
        """Why nothing is at a path, which the layer `by` names as a layer, if one does."""
        key = (path, authored, by)
        if key not in self._found:
            not_meant, reader = ((by, self._root), "") if by is not None else ((), self._root)
            self._found[key] = find_absence(self._disk, path, authored, not_meant, reader)
        return self._found[key]

    def common_folder(self, missing: Affected) -> str | None:
        """The topmost missing folder above all missing files, if their paths have one folder."""
        if len({split_path(sample.path)[0] for sample in missing.samples}) > 1:
            return None
        path = missing.place
        if path not in self._folders:
            self._folders[path] = missing_folder(self._disk, path)
        return self._folders[path]


def what_to_write(sequence: SampleSequence | None) -> str:
    """Which frames are there, by the numbers in their names, and what to do with the others."""
    if sequence is None or sequence.numbering is None:
        return _ANY
    numbers = sequence.numbering.numbers
    there, gone = (
        sorted(
            {n for n, each in zip(numbers, sequence.samples, strict=True) if each.state is state}
        )
        for state in (AssetState.FILE, AssetState.MISSING)
    )
    if not there or not gone or any(map(isnan, (*there, *gone))):
        return _ANY
    frames, others = ("frame" + "s" * (len(each) > 1) for each in (there, gone))
    is_there = f"{frames} {frame_ranges(there)} {'are' if len(there) > 1 else 'is'} there"
    return f"{is_there}: simulate or copy {others} {frame_ranges(gone)} again"
