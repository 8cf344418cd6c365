"""Arguments that are patterns: a shell that expands none, or quotes, leaves that to us."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Sequence
from fnmatch import fnmatchcase

from usdvol_lint.files.folders import folders_in
from usdvol_lint.paths import SUFFIXES

_MAGIC = re.compile(r"[*?[]")
_ANY_DEPTH = "**"


def is_glob(path: str) -> bool:
    """Whether a path has characters of a pattern; a file that is called so comes first."""
    return bool(_MAGIC.search(path))


def expand(pattern: str) -> list[str]:
    """The USD files and the folders that a pattern matches, sorted; `**` is any number of folders.

    A folder below another that matches is left out, since a search of that finds it.
    """
    pattern = os.path.normpath(pattern)
    first = _MAGIC.search(pattern)
    before = pattern.rfind(os.sep, 0, first.start() if first else None) + 1
    matched = sorted({*_matching(pattern[:before], pattern[before:].split(os.sep))})
    folders = {path for path in matched if os.path.isdir(path)}
    return [
        path
        for path in matched
        if (path in folders or path.lower().endswith(SUFFIXES)) and not _is_below(path, folders)
    ]


def _matching(folder: str, parts: Sequence[str]) -> Iterator[str]:
    """The paths below a folder that match."""
    if not parts:
        yield folder or os.curdir
        return
    part, rest = parts[0], parts[1:]
    if part == _ANY_DEPTH:
        inner = folders_in(folder or os.curdir) if rest else [folder]
    elif is_glob(part):
        inner = _named(folder, part)
    else:
        inner = [os.path.join(folder, part)]
    for path in inner:
        if os.path.isdir(path or os.curdir) if rest else os.path.lexists(path or os.curdir):
            yield from _matching(path, rest)


def _named(folder: str, pattern: str) -> list[str]:
    """The paths in a folder whose names match; what is hidden only where the pattern says so."""
    try:
        names = os.listdir(folder or os.curdir)
    except OSError:
        return []
    is_hidden_meant = pattern.startswith(".")
    return [
        os.path.join(folder, name)
        for name in sorted(names)
        if fnmatchcase(name, pattern) and (is_hidden_meant or not name.startswith("."))
    ]


def _is_below(path: str, folders: set[str]) -> bool:
    parent = os.path.dirname(path)
    while parent and parent != os.path.dirname(parent):
        if parent in folders:
            return True
        parent = os.path.dirname(parent)
    return "." in folders and path != "."
