"""The state of files on disk or in a package, each looked at once per stage."""

from __future__ import annotations

import os
import stat
from difflib import get_close_matches
from pathlib import Path
from typing import Any

from pxr import Ar

LFS_SIGNATURE = b"version https://git-lfs"
_LFS_POINTER_LIMIT = 1024


class Files:
    """What is wrong with a resolved file as such, and what lies beside a missing one."""

    def __init__(self) -> None:
        self._faults: dict[str, str | None] = {}
        self._listings: dict[str, tuple[str, ...]] = {}

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
            inspect = _package_fault if Ar.IsPackageRelativePath(resolved) else _file_fault
            self._faults[resolved] = inspect(resolved)
        return self._faults[resolved]

    def listing(self, folder: str) -> tuple[str, ...]:
        """The names in a folder, sorted; none if it can't be read."""
        if folder not in self._listings:
            try:
                self._listings[folder] = tuple(sorted(os.listdir(folder)))
            except OSError:
                self._listings[folder] = ()
        return self._listings[folder]

    def similar(self, path: str) -> str | None:
        """The name in the folder of a missing file that comes closest to it."""
        folder, name = os.path.split(path)
        names = self.listing(folder)
        folded = {other.lower(): other for other in names if other != name}
        matches = get_close_matches(name.lower(), folded, n=1, cutoff=0.84)
        return folded[matches[0]] if matches else None


def _file_fault(path: str) -> str | None:
    if not os.path.isabs(path):
        return None
    try:
        status = os.stat(path)
    except OSError as error:
        return error.strerror.lower() if error.strerror else "can't be read"
    if stat.S_ISDIR(status.st_mode):
        return "a folder"
    if not stat.S_ISREG(status.st_mode):
        return "not a regular file"
    if status.st_size == 0:
        return "empty (0 bytes)"
    if not os.access(path, os.R_OK):
        return "not readable (permission denied)"
    if status.st_size <= _LFS_POINTER_LIMIT and _starts_like_lfs(path):
        return "a Git-LFS pointer, not the file itself"
    return None


def _starts_like_lfs(path: str) -> bool:
    try:
        with Path(path).open("rb") as file:
            return file.read(len(LFS_SIGNATURE)) == LFS_SIGNATURE
    except OSError:
        return False


def _package_fault(path: str) -> str | None:
    asset: Any = Ar.GetResolver().OpenAsset(Ar.ResolvedPath(path))
    if asset is None:
        return "not readable inside the package"
    return "empty (0 bytes)" if asset.GetSize() == 0 else None
