"""Paths as users give and read them: which files to check, and how a place is shown."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator

SUFFIXES = (".usd", ".usda", ".usdc", ".usdz")
"""What USD's own layers end in."""
_IN_PACKAGE = r"(?is)(?P<package>.+?\.usdz)(?P<inside>\[.+\])"


def discover(paths: Iterable[str]) -> list[str]:
    """The stages to check: files as given, folders walked, each once, in the order given.

    Hidden folders are skipped.
    A folder that holds no stage or can't be read stays in the list, so that somebody says so.
    """
    found: dict[str, None] = {}
    for path in paths:
        inside = sorted(_inside(path)) if os.path.isdir(path) else []
        found.update(dict.fromkeys(inside or [path]))
    by_place: dict[str, str] = {}
    for path in found:
        by_place.setdefault(os.path.abspath(path), path)
    return list(by_place.values())


def _inside(folder: str) -> Iterator[str]:
    unreadable: list[OSError] = []
    for place, folders, files in os.walk(folder, onerror=unreadable.append):
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        for name in files:
            if name.lower().endswith(SUFFIXES) and not name.startswith("."):
                yield os.path.join(place, name)
    yield from (str(error.filename) for error in unreadable)


def display(path: str) -> str:
    """A path relative to the working directory, with `/`; `package.usdz[inner]` stays as it is."""
    package = re.fullmatch(_IN_PACKAGE, path) if path.endswith("]") else None
    outer, inner = (package["package"], package["inside"]) if package else (path, "")
    try:
        relative = os.path.relpath(outer)
    except ValueError:  # another drive
        relative = os.path.abspath(outer)
    return relative.replace(os.sep, "/") + inner
