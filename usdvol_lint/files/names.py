"""The names that a file goes by, with and without links, and whether it is among others."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator

from usdvol_lint.paths import composed

_HAS_CASE = sys.platform not in ("darwin", "win32")


def names_of(path: str) -> tuple[str, ...]:
    """The absolute names of a path by which it is compared: as it is, and without links.

    They are in lower case where the case of letters does not matter.
    """
    names = (_comparable(os.path.abspath(path)), _comparable(os.path.realpath(path)))
    return tuple(dict.fromkeys(names))


def _comparable(path: str) -> str:
    name = composed(path.replace(os.sep, "/"))
    return name if _HAS_CASE else name.casefold()


def is_among(path: str, changed: frozenset[str]) -> bool:
    """Whether a path changed, or a link or submodule above it."""
    return any(each in changed for name in names_of(path) for each in _upward(name))


def _upward(name: str) -> Iterator[str]:
    while name:
        yield name
        name = name.rpartition("/")[0]
