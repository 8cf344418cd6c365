"""Why nothing is at a path, and which path was probably meant."""

from __future__ import annotations

import errno
import os
from collections.abc import Callable, Collection, Iterator
from typing import NamedTuple

from pxr import Ar, Sdf

from usdvol_lint.facts.files.disk import Disk
from usdvol_lint.facts.files.paths import count_shared, is_packaged
from usdvol_lint.facts.files.patterns import matching_frames
from usdvol_lint.facts.files.places import place_of
from usdvol_lint.nearest import by_nearness
from usdvol_lint.words import quoted

_NAMED = 3


class Absence(NamedTuple):
    """Why nothing is at a path, in words that follow it, and which path was probably meant, if any.

    `elsewhere`: paths of which none is more probable, the nearest first.
    `file`: the file that stands where the path has a folder.
    """

    reason: str
    similar: str | None
    elsewhere: tuple[str, ...] = ()
    file: str = ""

    @property
    def advice(self) -> str | None:
        """Where such a file is."""
        if self.similar:
            return f"did you mean {quoted(self.similar)}?"
        if self.file:
            folder = os.path.dirname(self.file) or "."
            return f"name a folder in the place of that file, which itself is in {quoted(folder)}"
        if len(self.elsewhere) == 1:
            return (
                f"there is a file of that name at {quoted(self.elsewhere[0])}: did it move there?"
            )
        more = len(self.elsewhere) - _NAMED
        shown = ", ".join(map(quoted, self.elsewhere[:_NAMED])) + (f" and {more} more" * (more > 0))
        return f"there are files of that name at {shown}" if shown else None


def find_absence(
    disk: Disk, path: str, authored: str, not_meant: Collection[str] = (), reader: str = ""
) -> Absence:
    """Why nothing is at an absolute path; `authored` is the text that it comes from.

    `reader`: the layer of the stage, if one; where the text leads from the folder of another, the
    reason names the absolute place.
    `not_meant`: absolute paths of files that it certainly does not mean.
    Of what is no path on disk, such as a URI for an installed resolver, nothing is known.
    """
    if not os.path.isabs(path):
        return Absence("", None)
    authored, _ = Sdf.Layer.SplitIdentifier(authored)
    corrected = correct_case(disk, path, authored)
    if corrected and disk.in_case(path, count_shared(authored, path)) in not_meant:
        corrected = None
    if Ar.IsPackageRelativePath(path):
        package, inner = Ar.SplitPackageRelativePathOuter(path)
        if not os.path.isfile(package):
            return _absence_of_package(disk, package, authored)
        return _absence_inside(disk, package, inner, authored, corrected)
    missing = disk.first_missing(path)
    folder, name = os.path.split(missing)
    below = path[len(missing) :]
    if disk.is_file(folder):
        return _absence_below_file(folder, path, authored)
    similar = None if corrected else _closest_name(disk, folder, name, not_meant)
    has_file = bool(similar) and os.path.exists(f"{folder}/{similar}{below}")
    moved: tuple[str, ...] = ()
    if not (corrected or has_file):
        corrected, moved = _moved(path, missing, authored, disk.siblings_with)
    if similar and not (corrected or moved):
        corrected = _with_end(authored, name + below, similar + below if has_file else similar)
    if below and not corrected and not moved:
        moved = tuple(_in_folders_of(disk, folder, name + below, authored))
    return Absence(_reason(disk, path, missing, authored, reader), corrected, moved)


def _reason(disk: Disk, path: str, missing: str, authored: str, reader: str) -> str:
    """Why nothing is at a path of which this is the topmost part that is missing."""
    if disk.is_link(missing):
        return f": {_broken_link(missing)}"
    below = path[len(missing) :]
    led_to = os.path.normpath(os.path.join(os.path.dirname(reader), authored))
    is_at_home = not reader or led_to == path
    if not below and authored.replace("\\", "/").rpartition("/")[2] != os.path.basename(missing):
        return f", which is {quoted(missing)} here"
    if not below:
        return "" if is_at_home else f" in {quoted(os.path.dirname(missing))}"
    shown = _with_end(authored, below, "") if is_at_home else missing
    return f": no folder {quoted(shown)}"


def missing_folder(disk: Disk, path: str) -> str | None:
    """The topmost folder or package that does not exist above an absolute path, if one does not."""
    if is_packaged(path):
        package, inner = Ar.SplitPackageRelativePathOuter(path)
        if not os.path.isfile(package):
            return disk.first_missing(package)
        folder = disk.missing_in_package(package, inner)
        return str(Ar.JoinPackageRelativePath(package, folder)) if folder else None
    missing = disk.first_missing(path)
    return None if missing == path else missing


def correct_case(disk: Disk, path: str, authored: str) -> str | None:
    """The authored path as the disk spells it, if only the case differs; else None.

    `path` is its absolute form.
    """
    authored, _ = Sdf.Layer.SplitIdentifier(authored)
    if Ar.IsPackageRelativePath(path):
        package, inner = Ar.SplitPackageRelativePathOuter(path)
        actual = disk.listing(package).by_case.get(inner.lower(), inner)
        return _with_inner(authored, inner, actual) if actual != inner else None
    if not disk.has_folder(os.path.dirname(path), os.path.dirname(authored)):
        return None  # as for many files that lie in one
    count = count_shared(authored, path)
    found = disk.in_case(path, count)
    if found is None or found == path:
        return None
    return _with_end(authored, _last_names(path, count), _last_names(found, count))


def find_frames(disk: Disk, path: str, authored: str) -> list[tuple[int, str]]:
    """The frame numbers and paths of the files that a path with a placeholder stands for.

    `path` is the absolute form of `authored`; the paths begin as `authored` does.
    """
    folder, name, _ = place_of(path)
    found = matching_frames(name, disk.listing(folder).names)
    return [(frame.number, _with_end(authored, name, frame.name)) for frame in found]


def _absence_inside(
    disk: Disk, package: str, inner: str, authored: str, corrected: str | None
) -> Absence:
    """Why a package has nothing at a path in it; `corrected` is authored in another case."""
    folder = disk.missing_in_package(package, inner)
    moved: tuple[str, ...] = ()
    if similar := None if corrected else _closest_name(disk, package, inner):
        corrected = _with_inner(authored, inner, similar)
    elif not corrected:
        siblings = disk.listing(package).siblings_with
        corrected, moved = _moved(inner, folder or inner, authored, siblings)
    what = f": no folder {quoted(folder)}" if folder else ""
    return Absence(f"{what} in {quoted(os.path.basename(package))}", corrected, moved)


def _absence_of_package(disk: Disk, package: str, authored: str) -> Absence:
    shown, inner = Ar.SplitPackageRelativePathOuter(authored)
    reason, corrected, elsewhere, file = find_absence(disk, package, shown)
    if corrected and corrected.endswith(os.path.splitext(shown)[1]):  # else it corrects a folder
        corrected = str(Ar.JoinPackageRelativePath(corrected, inner))
    inside = tuple(str(Ar.JoinPackageRelativePath(other, inner)) for other in elsewhere)
    return Absence(reason or f": no package {quoted(shown)}", corrected, inside, file)


def _absence_below_file(file: str, path: str, authored: str) -> Absence:
    """Why nothing is at a path below a file; it may be meant to lie beside that."""
    shown = _with_end(authored, path[len(file) :], "")
    folder, name = os.path.dirname(file), os.path.basename(path)
    beside = _with_end(shown, os.path.basename(file), name)
    meant = beside if os.path.isfile(os.path.join(folder, name)) else None
    return Absence(f": {quoted(shown)} is a file, not a folder", meant, file=shown)


def _closest_name(
    disk: Disk, folder: str, name: str, not_meant: Collection[str] = ()
) -> str | None:
    """The closest other name in a folder."""
    excluded = frozenset(path.removeprefix(f"{folder}/") for path in not_meant)
    return disk.listing(folder).closest(name, excluded)


def _moved(
    path: str, missing: str, authored: str, siblings_with: Callable[[str, str], list[str]]
) -> tuple[str | None, tuple[str, ...]]:
    """What to write instead, or what of several, if the very file lies in sibling folders."""
    bracket = "]" if authored.endswith(f"{path}]") else ""
    bare = authored.removesuffix(bracket)
    moved = [other + bracket for other in _in_siblings(path, missing, bare, siblings_with)]
    return (moved[0], ()) if len(moved) == 1 else (None, tuple(moved))


def _in_siblings(
    path: str, missing: str, authored: str, siblings_with: Callable[[str, str], list[str]]
) -> Iterator[str]:
    """The path with the name of each sibling folder that has the very file, the nearest first.

    A sibling is one beside the folder that is missing; or, where only the file is, beside its own.
    Where that has a number, its neighbours in other folders are versions or takes of the frame.
    The folder has to be named in the path: what lies beside that of the layer is another asset.
    """
    folder, name = os.path.split(missing) if missing == path else (missing, "")
    if name and any(map(str.isdigit, name)):
        return
    below = path[len(folder) :]
    own_name = os.path.basename(folder)
    if own_name and authored.endswith(own_name + below):
        for sibling in by_nearness(own_name, siblings_with(folder, below)):
            yield _with_end(authored, own_name + below, sibling + below)


def _in_folders_of(disk: Disk, folder: str, below: str, authored: str) -> Iterator[str]:
    """What to write instead, where folders in the last one that is there have a file of the name.

    That is where a cache is that was moved or renamed.
    """
    file = below[below.rindex("/") :]
    for inside in disk.folders_with(folder, file) if authored.endswith(below) else ():
        yield _with_end(authored, below, inside + file)


def _broken_link(path: str) -> str:
    target = os.readlink(path)
    try:
        os.stat(path)
    except OSError as error:
        if error.errno == errno.ELOOP:
            return f"a symbolic link to {quoted(target)} that leads round in a circle"
    return f"a symbolic link to {quoted(target)}, which does not exist"


def _with_end(path: str, end: str, replacement: str) -> str:
    """The path with its end replaced; the replacement alone if the path does not end so."""
    return path.removesuffix(end) + replacement if path.endswith(end) else replacement


def _with_inner(path: str, inner: str, replacement: str) -> str:
    """A path in a package with its end replaced, which may be in brackets behind the package."""
    bracket = "]" if path.endswith(f"{inner}]") else ""
    return _with_end(path, inner + bracket, replacement + bracket)


def _last_names(path: str, count: int) -> str:
    return "/".join(path.split("/")[-count:])
