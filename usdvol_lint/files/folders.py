"""Searches folders for stages, those behind symbolic links too, each once."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Callable, Iterator
from typing import NamedTuple

from usdvol_lint.paths import SUFFIXES


class Found(NamedTuple):
    """A path, and which stage it is: the same name in the same folder, links resolved.

    `links` is how many of them the path leads through.

    A file that links to one in another folder is a stage of its own: what it names in relation to
    itself is somewhere else.
    """

    path: str
    key: tuple[str, str]
    links: int


class Search(NamedTuple):
    """What is below a folder; `has_skipped` says that some folders in it were not entered."""

    found: tuple[Found, ...]
    has_skipped: bool


def found_at(path: str) -> Found:
    """A path that was named, whether or not a stage is there."""
    real = os.path.realpath(path)
    folder = os.path.realpath(os.path.dirname(path) or os.curdir)
    return Found(path, (folder, real), _links_in(path))


def _links_in(path: str) -> int:
    """How many of the names of a path are links."""
    links, path = 0, os.path.abspath(path)
    while path != os.path.dirname(path):
        links += _is_link(path)
        path = os.path.dirname(path)
    return links


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
        self._links: deque[tuple[str, int]] = deque()
        self.folders: list[str] = []
        self.found: list[Found] = []
        self.has_skipped = False

    def run(self, folder: str) -> None:
        self._enter(folder, _links_in(folder))
        while self._links:
            self._enter(*self._links.popleft())

    def _enter(self, folder: str, links: int) -> None:
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
                self.found.append(Found(path, (real, real), links))
                continue
            for entry in entries:
                if not _is_folder(entry):
                    self._add(entry, real, links)
                elif self._skips(entry.path):
                    self.has_skipped = True
                elif not _is_link(entry.path):
                    waiting.append((entry.path, os.path.join(real, entry.name)))
                elif not _holds(os.path.realpath(entry.path), real):
                    self._links.append((entry.path, links + 1))

    def _add(self, entry: os.DirEntry[str], folder: str, links: int) -> None:
        if not entry.name.lower().endswith(SUFFIXES):
            return
        path = os.path.join(folder, entry.name)
        real = os.path.realpath(path) if entry.is_symlink() else path
        self.found.append(Found(entry.path, (folder, real), links + (real != path)))


def _visible(folder: str) -> Iterator[os.DirEntry[str]]:
    with os.scandir(folder) as entries:
        yield from (entry for entry in entries if not entry.name.startswith("."))


def _is_folder(entry: os.DirEntry[str]) -> bool:
    try:
        return entry.is_dir()
    except OSError:  # links in a circle
        return False


def _is_link(path: str) -> bool:
    """Whether a path is a symbolic link or, on Windows, a junction."""
    if os.name == "nt":
        folder = os.path.realpath(os.path.dirname(path) or os.curdir)
        return os.path.realpath(path) != os.path.join(folder, os.path.basename(path))
    return os.path.islink(path)


def _holds(folder: str, inner: str) -> bool:
    """Whether a folder is another one or above it, so that a search would not end."""
    start = folder.rstrip(os.sep) + os.sep
    return (inner.rstrip(os.sep) + os.sep).startswith(start)
