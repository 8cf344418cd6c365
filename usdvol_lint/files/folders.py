"""Searches folders for stages, those behind symbolic links too, each once."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Callable, Iterator
from typing import NamedTuple

from usdvol_lint.paths import SUFFIXES


class Found(NamedTuple):
    """A path, and which stage it is: the same name in the same folder, links resolved.

    A file that links to one in another folder is a stage of its own: what it names in relation to
    itself is somewhere else.
    """

    path: str
    key: tuple[str, str]
    is_linked: bool


class Search(NamedTuple):
    """What is below a folder; `has_skipped` says that some folders in it were not entered."""

    found: tuple[Found, ...]
    has_skipped: bool


def found_at(path: str) -> Found:
    """A path that was named, whether or not a stage is there."""
    real = os.path.realpath(path)
    folder = os.path.realpath(os.path.dirname(path) or os.curdir)
    return Found(path, (folder, real), _is_linked(path, real))


def _is_linked(path: str, real: str) -> bool:
    return os.path.normcase(os.path.abspath(path)) != os.path.normcase(real)


def stages_in(folder: str, skips: Callable[[str], bool] = lambda folder: False) -> Search:
    """The stages below a folder, but for hidden ones, sorted by path.

    What is behind links is found once, where it has a path without links by that.
    A folder that can't be read is there itself, so that it is reported.
    """
    search = _Search(skips)
    search.run(folder)
    return Search(tuple(sorted(search.found)), search.has_skipped)


def folders_in(folder: str) -> list[str]:
    """A folder and all folders below it but hidden ones, each once."""
    search = _Search(lambda folder: False)
    search.run(folder)
    return search.folders


class _Search:
    """Enters each folder once; links only after all that has a path without them."""

    def __init__(self, skips: Callable[[str], bool]) -> None:
        self._skips = skips
        self._entered: set[str] = set()
        self._links: deque[str] = deque()
        self.folders: list[str] = []
        self.found: list[Found] = []
        self.has_skipped = False

    def run(self, folder: str) -> None:
        self._enter(folder, is_linked=_is_link(folder))
        while self._links:
            self._enter(self._links.popleft(), is_linked=True)

    def _enter(self, folder: str, is_linked: bool) -> None:
        waiting = [(folder, os.path.realpath(folder))]
        while waiting:
            path, real = waiting.pop()
            if real in self._entered:
                continue
            self._entered.add(real)
            self.folders.append(path)
            try:
                entries = list(_visible(path))
            except OSError:
                self.found.append(Found(path, (real, real), is_linked))
                continue
            for entry in entries:
                if not _is_folder(entry):
                    self._add(entry, real, is_linked)
                elif self._skips(entry.path):
                    self.has_skipped = True
                elif not _is_link(entry.path):
                    waiting.append((entry.path, os.path.join(real, entry.name)))
                elif not _holds(os.path.realpath(entry.path), real):
                    self._links.append(entry.path)

    def _add(self, entry: os.DirEntry[str], folder: str, is_linked: bool) -> None:
        if not entry.name.lower().endswith(SUFFIXES):
            return
        path = os.path.join(folder, entry.name)
        real = os.path.realpath(path) if entry.is_symlink() else path
        self.found.append(Found(entry.path, (folder, real), is_linked or real != path))


def _visible(folder: str) -> Iterator[os.DirEntry[str]]:
    with os.scandir(folder) as entries:
        yield from (entry for entry in entries if not entry.name.startswith("."))


def _is_folder(entry: os.DirEntry[str]) -> bool:
    try:
        return entry.is_dir()
    except OSError:  # links in a circle
        return False


def _is_link(folder: str) -> bool:
    """Whether a folder is a symbolic link or, on Windows, a junction."""
    if os.name == "nt":
        return os.path.realpath(folder) != os.path.join(
            os.path.realpath(os.path.dirname(folder) or os.curdir), os.path.basename(folder)
        )
    return os.path.islink(folder)


def _holds(folder: str, inner: str) -> bool:
    """Whether a folder is another one or above it, so that a search would not end."""
    start = folder.rstrip(os.sep) + os.sep
    return (inner.rstrip(os.sep) + os.sep).startswith(start)
