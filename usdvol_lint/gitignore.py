"""Patterns as in a .gitignore, matched in time that grows with the path and not with the stars."""

from __future__ import annotations

import re
from collections.abc import Container, Iterable, Mapping
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathspec import GitIgnoreSpec

_STARS = {"[^/]*": "[^/]*?", "[^/]+": "[^/]+?"}
_FOLDERS = {"(?:.+/)?": "(?:.+?/)??", "(?:/.+)?": "(?:/.+?)??"}
"""What pathspec makes of `*` and `**`, and the same that tries the least first."""
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
    in_names = _committed(tokens, _STARS, ends=("/", *_FOLDERS))
    return "".join(_committed(in_names, _FOLDERS, then="(?=/)"))


def _without_slash(token: str) -> str:
    is_class = token.startswith("[") and token not in (*_STARS, "[^/]")
    return f"(?!/){token}" if is_class else token


def _committed(
    tokens: list[str], wild: Mapping[str, str], ends: Container[str] = (), then: str = ""
) -> list[str]:
    """The tokens, what stands from one that is wild to the next one as a group that is kept.

    `ends` are tokens that none of them matches across, `then` is what has to follow a group.
    """
    found: list[str] = []
    first: int | None = None
    for token in tokens:
        if token in wild:
            if first is not None:
                found[first:] = [f"(?>{wild[found[first]]}{''.join(found[first + 1 :])}{then})"]
            first = len(found)
        elif token in ends:
            first = None
        found.append(token)
    return found
