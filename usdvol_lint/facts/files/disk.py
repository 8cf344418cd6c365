"""The state of files and folders, on disk or in a package, each looked at once per stage."""

from __future__ import annotations

import os
import stat
from typing import Any

from pxr import Ar

from usdvol_lint.config import Storage
from usdvol_lint.facts.files.folders import Folders, Listing
from usdvol_lint.facts.files.paths import count_shared, is_packaged
from usdvol_lint.facts.files.places import folders_above
from usdvol_lint.facts.files.states import FileFault
from usdvol_lint.facts.files.storage import Whereabouts
from usdvol_lint.facts.usd.diagnostics import UNREADABLE
from usdvol_lint.volumefile.signatures import LFS_POINTER

_LFS_POINTER_LIMIT = 1024
_NAMES_TRIED = 2_000
"""In so many folders, for all paths of a stage, a file is looked for that may have moved.

Not of a run: then it would depend on the stages before what is said of one.
"""


class Disk:
    """Looks at files and folders, and keeps what it saw for all variant selections of a stage.

    What it says of a folder it says of a package, `package.usdz`, too.
    `folders` know what is in them, for the stages before and after this one too, and `storage`
    which files are elsewhere, or are not looked for.
    """

    def __init__(self, folders: Folders | None = None, storage: Whereabouts | None = None) -> None:
        self.storage = storage or Whereabouts(Storage())
        self._all_folders = folders or Folders()
        self._faults: dict[str, str | None] = {}
        self._listings: dict[str, Listing] = {}
        self._missing: dict[str, str | None] = {}
        self._in_case: dict[tuple[str, int], str | None] = {}
        self._siblings: dict[str, tuple[str, ...]] = {}
        self._tried: set[tuple[str, str]] = set()
        self._has_folder: dict[tuple[str, str], bool] = {}
        self._files: dict[str, bool] = {}
        self._links: dict[str, bool] = {}
        self._names_left = _NAMES_TRIED

    @property
    def checked(self) -> int:
        """How many distinct files were asked for their fault."""
        return len(self._faults)

    def fault(self, resolved: str) -> str | None:
        """Why a resolved path is no readable file with content, or None; see `file_fault`."""
        if resolved not in self._faults:
            self._faults[resolved] = file_fault(resolved)
        return self._faults[resolved]

    def listing(self, folder: str) -> Listing:
        """What is in a folder; nothing if it can't be read."""
        if folder not in self._listings:
            self._listings[folder] = self._all_folders.listing(folder)
        return self._listings[folder]

    def first_missing(self, path: str) -> str:
        """The topmost folder of an absolute path that does not exist, or the whole path."""
        folder = os.path.dirname(path)
        if folder not in self._missing:
            self._missing[folder] = _first_missing(folder)
        return self._missing[folder] or path

    def is_file(self, path: str) -> bool:
        """Whether a file is at an absolute path; many paths go through one that is no folder."""
        if path not in self._files:
            self._files[path] = os.path.isfile(path)
        return self._files[path]

    def is_link(self, path: str) -> bool:
        """Whether a link is at an absolute path; many paths go through one that leads nowhere."""
        if path not in self._links:
            self._links[path] = os.path.islink(path)
        return self._links[path]

    def missing_in_package(self, package: str, inner: str) -> str | None:
        """The topmost folder that a package lacks above a path in it, if it lacks one.

        A package of which nothing can be read may have any.
        """
        listing = self.listing(package)
        if inner.startswith("../") or not listing.names:
            return None
        outermost = inner.partition("[")[0]
        missing = (each for each in folders_above(outermost) if each not in listing.folders)
        return next(missing, None)

    def siblings_with(self, folder: str, below: str) -> list[str]:
        """The names of the folders beside another that have a file at the path `below`, `/a.vdb`.

        Which folders come into question is looked for once for each `folder`, by the first file.
        """
        parent = os.path.dirname(folder)
        if folder not in self._siblings:
            is_top = os.path.dirname(parent) == parent
            self._siblings[folder] = () if is_top else self._with_file(parent, below)
        return [
            name for name in self._siblings[folder] if os.path.isfile(f"{parent}/{name}{below}")
        ]

    def folders_with(self, folder: str, below: str) -> tuple[str, ...]:
        """The names of the folders in one that have a file at the path `below`, `/a.vdb`."""
        is_top = os.path.dirname(folder) == folder
        return () if is_top else self._with_file(folder, below)

    def _with_file(self, folder: str, below: str) -> tuple[str, ...]:
        """The same of any folder; none of them once too many names were tried."""
        if (folder, below) not in self._tried:
            names = len(self.listing(folder).names)
            if names > self._names_left:
                return ()
            self._names_left -= names
            self._tried.add((folder, below))
        return self._all_folders.with_file(folder, below)

    def in_case(self, path: str, count: int) -> str | None:
        """An absolute path with its last `count` names as the folders on disk spell them.

        None where nothing of that name is there in any case.
        """
        unknown = []
        while count and (path, count) not in self._in_case and os.path.basename(path):
            unknown.append((path, count))
            path, count = os.path.dirname(path), count - 1
        actual = self._in_case.get((path, count), path)
        for key in reversed(unknown):
            actual = self._in_case[key] = self._with_name_in_case(actual, key[0])
        return actual

    def has_folder(self, folder: str, authored: str) -> bool:
        """Whether a folder is there in any case of the names that its path as authored has."""
        key = folder, authored
        if key not in self._has_folder:
            found = self.in_case(folder, count_shared(authored, folder))
            self._has_folder[key] = found is not None
        return self._has_folder[key]

    def _with_name_in_case(self, folder: str | None, path: str) -> str | None:
        """The name of a path as a folder spells it, behind that of the folder."""
        if folder is None:
            return None
        names, name = self.listing(folder).by_case, os.path.basename(path)
        actual = names.get(name) or names.get(name.lower())
        return f"{folder.rstrip('/')}/{actual}" if actual else None

    def ignores_case(self, path: str) -> bool:
        """Whether the file system finds an existing file under another case of its name."""
        return self._all_folders.ignores_case(path)


def _first_missing(folder: str) -> str | None:
    """The topmost of a folder and those above it that does not exist; None if it is there."""
    missing = None
    while folder != missing and not os.path.exists(folder):
        missing, folder = folder, os.path.dirname(folder)
    return missing


def file_fault(path: str) -> str | None:
    """Why a path is no readable file with content, or None.

    Paths are absolute, or `package.usdz[inner]`; of others, such as a URI that an installed
    resolver answers for, there is no fault.
    """
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
    if _may_be_lfs(status.st_size) and _starts_like_lfs(path):
        return FileFault.LFS_POINTER
    return None


def _may_be_lfs(size: int) -> bool:
    return len(LFS_POINTER) < size <= _LFS_POINTER_LIMIT


def _starts_like_lfs(path: str) -> bool:
    try:
        with open(path, "rb", buffering=0) as file:  # Path takes three times as long
            return file.read(len(LFS_POINTER)) == LFS_POINTER
    except OSError:
        return False


def _package_fault(path: str) -> str | None:
    try:
        asset: Any = Ar.GetResolver().OpenAsset(Ar.ResolvedPath(path))
    except UNREADABLE:
        return FileFault.PACKED
    if asset is None:
        return FileFault.UNREADABLE
    size = asset.GetSize()
    if size == 0:
        return FileFault.EMPTY
    is_pointer = _may_be_lfs(size) and bytes(asset.GetBuffer()).startswith(LFS_POINTER)
    return FileFault.LFS_POINTER if is_pointer else None
