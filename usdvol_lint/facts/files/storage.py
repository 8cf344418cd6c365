"""Where files are on this machine: beginnings of paths that lead elsewhere, files assumed there."""

from __future__ import annotations

import ntpath
import os
import posixpath
import re
from collections.abc import Callable, Iterable, Mapping

from usdvol_lint.config import Storage

_DRIVE = re.compile(r"[A-Za-z]:")
_ROOT = re.compile(r"[A-Za-z]:/|/|[A-Za-z][A-Za-z0-9+-]+://")


class Whereabouts:
    """Answers for the paths that a configuration speaks of, of which most stages have none."""

    def __init__(self, storage: Storage) -> None:
        self._map = storage.path_map
        self._is_assumed = _matching(storage.assume_present) if storage.assume_present else None
        self.knows_any = bool(storage.path_map or storage.assume_present)
        self.assumed: set[str] = set()

    def led_to(self, *paths: str) -> str:
        """The absolute path that one of these names of a file leads to; empty if none does.

        Of several that is the first with a file, or else the first.
        """
        led = [path for path in (mapped(path, self._map) for path in paths) if path]
        there = filter(os.path.isfile, led)
        return _plain(os.path.abspath(next(there, led[0]))) if led else ""

    def is_assumed(self, *paths: str) -> bool:
        """Whether a file of one of these names is assumed to be there; it is counted.

        Absolute names count, and others only where none is absolute.
        """
        if self._is_assumed is None or not any(map(self._is_assumed, _absolute(paths) or paths)):
            return False
        self.assumed.add(paths[-1])
        return True


def mapped(path: str, by_start: Mapping[str, str]) -> str | None:
    """A path with its beginning replaced, the longest that is known; None if none is."""
    plain = _normal(path)
    starts = [start for start in by_start if _begins(plain, _plain(start))]
    if not starts:
        return None
    start = max(starts, key=len)
    to = by_start[start].rstrip("/\\")
    return f"{to}/{plain[len(_plain(start)) :].lstrip('/')}"


def _begins(path: str, start: str) -> bool:
    """Whether a path is in a folder, by whole names; drive letters have no case."""
    if _DRIVE.match(start):
        path, start = path[:1].lower() + path[1:], start[:1].lower() + start[1:]
    return path.startswith(start) and (start.endswith("/") or path[len(start) :][:1] in ("", "/"))


def _matching(patterns: tuple[str, ...]) -> Callable[[str], bool]:
    from usdvol_lint.suppressions import matching

    matches = matching([_from_root(pattern) for pattern in patterns])
    return lambda path: matches(_from_root(_normal(path)).lstrip("/"))


def _absolute(paths: Iterable[str]) -> list[str]:
    return [path for path in paths if _ROOT.match(_plain(path))]


def _from_root(path: str) -> str:
    """A path or pattern with `/` between names, at most one before, and its drive in capitals."""
    plain = _plain(path)
    if _DRIVE.match(plain):
        return plain[:1].upper() + plain[1:]
    return re.sub(r"^/+", "/", plain)


def _normal(path: str) -> str:
    """A path with `/` between names; without `.` and `..` where it is absolute."""
    plain = _plain(path)
    root = _ROOT.match(plain)
    if not root:
        return plain
    if _DRIVE.match(root[0]):
        return _plain(ntpath.normpath(plain))
    scheme = root[0] if ":" in root[0] else ""
    return scheme + posixpath.normpath(plain[len(scheme) :])


def _plain(path: str) -> str:
    return path.replace("\\", "/")
