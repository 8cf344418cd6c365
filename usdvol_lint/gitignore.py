"""Patterns as in a .gitignore, matched in time that grows with the path and not with the stars."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathspec import GitIgnoreSpec

_STARS = ("[^/]*", "[^/]+")
_FOLDERS = {"(?:.+/)?": "(?:.+?/)??", "(?:/.+)?": "(?:/.+?)??"}
"""What pathspec makes of `**`, and the same that tries the nearest folder first."""
_TOKEN = re.compile(
    "|".join(map(re.escape, (*_FOLDERS, *_STARS))) + r"|\[\^?\]?(?:\\.|[^\]\\])*\]|\\.|.", re.DOTALL
)


def spec_of(lines: Iterable[str]) -> GitIgnoreSpec:
    """What matches a list of patterns; raises ValueError for one that is none."""
    from pathspec import GitIgnoreSpec  # few runs have a pattern

    spec = GitIgnoreSpec.from_lines(lines)
    for pattern in spec.patterns:
        if pattern.regex is not None:
            pattern.regex = re.compile(in_one_pass(pattern.regex.pattern))
    return spec


def in_one_pass(regex: str) -> str:
    """The same regular expression, of pathspec's, which never goes back over what it passed.

    What stands between two stars may as well match where it does first, since the second star takes
    whatever is left; what comes after the last one is tried everywhere.  The same holds for `**`.
    No class of characters has the slash in it, as in git.
    """
    tokens = [_without_slash(token) for token in _TOKEN.findall(regex)]
    return "".join(_atomic_folders(_atomic_stars(tokens)))


def _without_slash(token: str) -> str:
    is_class = token.startswith("[") and token not in (*_STARS, "[^/]")
    return f"(?!/){token}" if is_class else token


def _atomic_stars(tokens: list[str]) -> list[str]:
    found: list[str] = []
    star: int | None = None
    for token in tokens:
        if token in _STARS:
            if star is not None:
                found[star:] = [f"(?>{found[star]}?{''.join(found[star + 1 :])})"]
            star = len(found)
        elif token in _FOLDERS or "/" in token[:1]:
            star = None
        found.append(token)
    return found


def _atomic_folders(tokens: list[str]) -> list[str]:
    found: list[str] = []
    folders: int | None = None
    for token in tokens:
        if token in _FOLDERS:
            if folders is not None:
                inside = "".join(found[folders + 1 :])
                found[folders:] = [f"(?>{_FOLDERS[found[folders]]}{inside}(?=/))"]
            folders = len(found)
        found.append(token)
    return found
