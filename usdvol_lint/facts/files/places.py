"""Where files are listed: in a folder by their names, in a package by their paths in there."""

from __future__ import annotations

import os
from collections.abc import Iterator
from typing import NamedTuple

from pxr import Ar

from usdvol_lint.facts.files.paths import is_packaged


class Place(NamedTuple):
    """A file by the folder or package that lists it, and its name in that list."""

    folder: str
    name: str
    is_packaged: bool

    @property
    def split(self) -> tuple[str, str]:
        """The folder in the package, empty at its top and on disk, and the name in there."""
        inside, _, name = self.name.rpartition("/")
        return inside, name

    def beside(self, name: str) -> str:
        """The path of another file in the same list."""
        if self.is_packaged:
            return str(Ar.JoinPackageRelativePath(self.folder, name))
        return f"{self.folder.rstrip('/')}/{name}"


def place_of(path: str) -> Place:
    """The place of a file by its absolute path, whether or not anything is there."""
    if is_packaged(path):
        package, inner = Ar.SplitPackageRelativePathOuter(path)
        return Place(package, inner, True)
    return Place(*os.path.split(path), False)


def folders_above(name: str) -> Iterator[str]:
    """The folders in the path of a file in a package, the topmost first."""
    yield from (name[:at] for at, letter in enumerate(name) if letter == "/")


def names_listed(folder: str) -> list[str]:
    """The names in a folder or package, sorted; none if it can't be read."""
    if os.path.isfile(folder):
        from usdvol_lint.volumefile.package import Package  # costs start-up time; few stages ask

        return sorted(Package(folder).names)
    try:
        return sorted(os.listdir(folder))
    except OSError:
        return []
