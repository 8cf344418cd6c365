"""Lists the stages to check: files as given, and those below folders."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator

from usdvol_lint.paths import SUFFIXES


def discover(paths: Iterable[str]) -> list[str]:
    """The paths of stages: files as given, and those below folders; each once, in that order.

    Hidden files and folders are skipped.
    A folder that holds no stage or can't be read stays in the list, so that it is reported.
    """
    found: dict[str, None] = {}
    for path in paths:
        inside = sorted(_inside(path)) if os.path.isdir(path) else []
        found.update(dict.fromkeys(inside or [path]))
    by_absolute_path: dict[str, str] = {}
    for path in found:
        by_absolute_path.setdefault(os.path.abspath(path), path)
    return list(by_absolute_path.values())


def _inside(folder: str) -> Iterator[str]:
    unreadable: list[OSError] = []
    for parent, folders, files in os.walk(folder, onerror=unreadable.append):
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        for name in files:
            if name.lower().endswith(SUFFIXES) and not name.startswith("."):
                yield os.path.join(parent, name)
    yield from (str(error.filename) for error in unreadable)
