"""The state of files on disk or in a package, each looked at once per stage."""

from __future__ import annotations

import errno
import os
import re
import stat
from collections import defaultdict
from collections.abc import Iterable
from typing import Any, NamedTuple, TypeAlias

from pxr import Ar, Sdf, Tf

from usdvol_lint.facts.files.patterns import matching_frames
from usdvol_lint.facts.files.states import FileFault
from usdvol_lint.model import quoted
from usdvol_lint.nearest import closest_match
from usdvol_lint.volumefile.signatures import LFS_POINTER

_LFS_POINTER_LIMIT = 1024
_NUMBER = re.compile(r"[0-9]+")

Numbers: TypeAlias = tuple[int, ...]


class Absence(NamedTuple):
    """Why nothing is at a path, in words that follow it, and the path that may have been meant."""

    reason: str
    similar: str | None


class Disk:
    """The state of files: what is wrong with one as such, and what lies beside a missing one."""

    def __init__(self) -> None:
        self._faults: dict[str, str | None] = {}
        self._listings: dict[str, tuple[str, ...]] = {}
        self._by_numbers: dict[str, dict[Numbers, list[str]]] = {}
        self._by_case: dict[str, dict[str, str]] = {}
        self._in_case: dict[tuple[str, int], str | None] = {}
        self._ignores_case: dict[str, bool] = {}

    @property
    def checked(self) -> int:
        """How many distinct files were looked at."""
        return len(self._faults)

    def fault(self, resolved: str) -> str | None:
        """Why a resolved path can't be a readable file with content, or None.

        Paths are absolute file names, or `package.usdz[inner]`; other forms, such as a URI that
        an installed resolver answers for, are taken at the resolver's word.
        """
        if resolved not in self._faults:
            self._faults[resolved] = file_fault(resolved)
        return self._faults[resolved]

    def listing(self, folder: str) -> tuple[str, ...]:
        """The names in a folder, or in a package, sorted; none if it can't be read."""
        if folder not in self._listings:
            names = _package_names if os.path.isfile(folder) else os.listdir
            try:
                self._listings[folder] = tuple(sorted(names(folder)))
            except OSError:
                self._listings[folder] = ()
        return self._listings[folder]

    def absence(self, path: str, authored: str) -> Absence:
        """What is known of an absolute path where nothing is; `authored` is how it was written."""
        authored, _ = Sdf.Layer.SplitIdentifier(authored)
        corrected = self.recased(path, authored)
        if Ar.IsPackageRelativePath(path):
            package, inner = Ar.SplitPackageRelativePathOuter(path)
            if not os.path.isfile(package):
                return self._absence_of_package(package, authored)
            similar = None if corrected else self._nearest(package, inner)
            corrected = _with_end(authored, inner, similar) if similar else corrected
            return Absence(f" in {quoted(os.path.basename(package))}", corrected)
        missing = _first_missing(path)
        folder, name = os.path.split(missing)
        rest = path[len(missing) :]
        shown = _with_end(authored, rest, "") if rest else authored
        similar = None if corrected else self._nearest(folder, name)
        if similar:
            whole = os.path.exists(os.path.join(folder, similar) + rest)
            corrected = _with_end(authored, name + rest, similar + rest if whole else similar)
        if os.path.islink(missing):
            return Absence(f": {_broken_link(missing)}", corrected)
        return Absence(f": no folder {quoted(shown)}" if rest else "", corrected)

    def _absence_of_package(self, package: str, authored: str) -> Absence:
        shown, inner = Ar.SplitPackageRelativePathOuter(authored)
        reason, corrected = self.absence(package, shown)
        if corrected and corrected.endswith(os.path.splitext(shown)[1]):  # else it is a folder
            corrected = str(Ar.JoinPackageRelativePath(corrected, inner))
        return Absence(reason or f": no package {quoted(shown)}", corrected)

    def recased(self, path: str, authored: str) -> str | None:
        """What `authored` should be for the folders to have its names, where only the case differs.

        `path` is its absolute form; None where nothing is there in any case, or where it is right.
        """
        authored, _ = Sdf.Layer.SplitIdentifier(authored)
        if Ar.IsPackageRelativePath(path):
            package, inner = Ar.SplitPackageRelativePathOuter(path)
            there = self.names(package).get(inner.lower(), inner)
            return _with_end(authored, inner, there) if there != inner else None
        found = self.in_case(path, authored)
        if found is None or found == path:
            return None
        count = _count_names(authored)
        return _with_end(authored, _last_names(path, count), _last_names(found, count))

    def in_case(self, path: str, authored: str) -> str | None:
        """An absolute path with the names that `authored` says of it as their folders have them.

        None where nothing is there in any case.
        """
        return self._with_names_in_case(path, _count_names(authored))

    def _with_names_in_case(self, path: str, count: int) -> str | None:
        folder, name = os.path.split(path)
        if count == 0 or not name:
            return path
        key = (folder, count - 1)
        if key not in self._in_case:
            self._in_case[key] = self._with_names_in_case(*key)
        folder_there = self._in_case[key]
        if folder_there is None:
            return None
        names = self.names(folder_there)
        name_there = names.get(name) or names.get(name.lower())
        return f"{folder_there.rstrip('/')}/{name_there}" if name_there else None

    def names(self, folder: str) -> dict[str, str]:
        """The names in a folder, or in a package, by themselves and by their lower case."""
        if folder not in self._by_case:
            listing = self.listing(folder)
            lower = {name.lower(): name for name in listing}
            self._by_case[folder] = lower | {name: name for name in listing}
        return self._by_case[folder]

    def ignores_case(self, path: str) -> bool:
        """Whether the folder of a file that is there finds it under another case of its name."""
        folder, _, name = path.rpartition("/")
        if folder not in self._ignores_case:
            try:
                same = os.path.samefile(path, f"{folder}/{name.swapcase()}")
            except OSError:
                same = False
            self._ignores_case[folder] = same
        return self._ignores_case[folder]

    def frames(self, path: str, authored: str) -> list[tuple[int, str]]:
        """The files that a path with a placeholder for the frame stands for, by frame number.

        `path` is the absolute form of `authored`, in whose words the files are named.
        """
        folder, name = os.path.split(path)
        found = matching_frames(name, self.listing(folder))
        return [(frame.number, _with_end(authored, name, frame.name)) for frame in found]

    def _nearest(self, folder: str, name: str) -> str | None:
        """The name in a folder that comes closest: another number is no misspelling."""
        if folder not in self._by_numbers:
            self._by_numbers[folder] = _group_by_numbers(self.listing(folder))
        others = self._by_numbers[folder].get(_numbers(name), ())
        return closest_match(name, (other for other in others if other != name))


def is_packaged(path: str) -> bool:
    """Whether a path names a file in a package, `package.usdz[inner]`."""
    return path.endswith("]") and bool(Ar.IsPackageRelativePath(path))


def file_fault(path: str) -> str | None:
    """Why an absolute path, or one in a package, is no readable file with content, or None."""
    if is_packaged(path):
        return _package_fault(path)
    if not os.path.isabs(path):
        return None
    try:
        status = os.stat(path)
    except OSError:
        return FileFault.BROKEN_LINK if os.path.islink(path) else FileFault.UNREADABLE
    if stat.S_ISDIR(status.st_mode):
        return FileFault.FOLDER
    if not stat.S_ISREG(status.st_mode):
        return FileFault.SPECIAL
    if status.st_size == 0:
        return FileFault.EMPTY
    if not status.st_mode & stat.S_IROTH and not os.access(path, os.R_OK):
        return FileFault.UNREADABLE
    if len(LFS_POINTER) < status.st_size <= _LFS_POINTER_LIMIT and _starts_like_lfs(path):
        return FileFault.LFS_POINTER
    return None


def _starts_like_lfs(path: str) -> bool:
    try:
        with open(path, "rb", buffering=0) as file:  # Path takes three times as long
            return file.read(len(LFS_POINTER)) == LFS_POINTER
    except OSError:
        return False


def _package_fault(path: str) -> str | None:
    try:
        asset: Any = Ar.GetResolver().OpenAsset(Ar.ResolvedPath(path))
    except Tf.ErrorException:
        return FileFault.PACKED
    if asset is None:
        return FileFault.UNREADABLE
    return FileFault.EMPTY if asset.GetSize() == 0 else None


def _package_names(package: str) -> list[str]:
    from zipfile import BadZipFile, ZipFile  # costs start-up time, and few stages ask

    try:
        with ZipFile(package) as archive:
            return archive.namelist()
    except BadZipFile:
        return []


def _first_missing(path: str) -> str:
    """The first part of an absolute path that is not there: a folder, or the whole path."""
    while not os.path.exists(parent := os.path.dirname(path)) and parent != path:
        path = parent
    return path


def _broken_link(path: str) -> str:
    target = os.readlink(path)
    try:
        os.stat(path)
    except OSError as error:
        if error.errno == errno.ELOOP:
            return f"a symbolic link to {quoted(target)} that leads round in a circle"
    return f"a symbolic link to {quoted(target)}, which does not exist"


def _with_end(path: str, end: str, replacement: str) -> str:
    """The path with another end; the replacement alone where the path does not end so."""
    return path.removesuffix(end) + replacement if path.endswith(end) else replacement


def _count_names(path: str) -> int:
    """How many names a path has that folders list: those after `.` and `..`."""
    names = os.path.normpath(path).replace(os.sep, "/").split("/")
    return sum(name not in ("", ".", "..") for name in names)


def _last_names(path: str, count: int) -> str:
    return "/".join(path.split("/")[-count:])


def _group_by_numbers(names: Iterable[str]) -> dict[Numbers, list[str]]:
    groups: dict[Numbers, list[str]] = defaultdict(list)
    for name in names:
        groups[_numbers(name)].append(name)
    return groups


def _numbers(name: str) -> Numbers:
    return tuple(map(int, _NUMBER.findall(name)))
