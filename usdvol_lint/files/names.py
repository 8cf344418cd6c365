"""The names that a file goes by, with and without links, and whether it is among others."""

from __future__ import annotations

import os
from collections.abc import Iterator

from usdvol_lint.paths import canonical


def names_of(path: str) -> tuple[str, ...]:
    """The absolute names of a path, with `/`: as it is, and without links."""
    absolute = os.path.abspath(path).replace(os.sep, "/")
    return tuple(dict.fromkeys((absolute, canonical(path))))


def is_among(path: str, changed: frozenset[str]) -> bool:
    """Whether a path changed, or a link or submodule above it."""
    return any(each in changed for name in names_of(path) for each in _upward(name))


def _upward(name: str) -> Iterator[str]:
    while name:
        yield name
        name = name.rpartition("/")[0]
