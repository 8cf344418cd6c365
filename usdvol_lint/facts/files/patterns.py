"""Placeholders in paths, which USD does not replace, and the files that they stand for."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import NamedTuple

from usdvol_lint.facts.files.frame_names import LONGEST_NUMBER

_MARK = re.compile(r"[$%#@<{*`]")
_FRAME = re.compile(
    r"""
      \$\{S?FF?\d*\}  | \$S?FF?(?P<houdini>\d*)(?![A-Za-z_])          # $F, $F4, ${F4}, $SF, $FF
    | %0?(?P<printf>\d*)d(?![a-z])                                     # %d, %04d
    | \#{2,} | (?<![A-Za-z0-9])\#(?![A-Za-z0-9])                       # ####
    | @{2,}                                                            # @@@
    | <(?:frame|f)(?P<renderman>\d*)>                                  # <f>, <f4>, <frame>
    | \{frame(?::0?(?P<python>\d*)d?)?\}                               # {frame}, {frame:04d}
    """,
    re.VERBOSE | re.IGNORECASE,
)
_OTHER = re.compile(
    r"<(?:UDIM|UVTILE)>|%\(UDIM\)d|\$\{[A-Za-z_]\w*\}|\$[A-Za-z_]\w*|%[A-Za-z_]\w*%|[*]|`[^`]*`",
    re.IGNORECASE,
)
_VARIABLE = re.compile(r"\$\{([A-Za-z_]\w*)\}|\$([A-Za-z_]\w*)|%([A-Za-z_]\w*)%")


class Frame(NamedTuple):
    """A file that a pattern stands for: its frame number and its name."""

    number: int
    name: str


def find_pattern(path: str) -> str | None:
    """The placeholders in a path, as written, with `' and '` between; None if it has none."""
    if not _MARK.search(path):
        return None
    frames = {each.start(): each for each in _FRAME.finditer(path)}
    found = {each.start(): each for each in _OTHER.finditer(path)} | frames
    written, end = [], 0
    for start in sorted(found):
        if start >= end:
            written.append(found[start].group())
            end = found[start].end()
    return "' and '".join(dict.fromkeys(written)) or None


def has_frame(path: str) -> bool:
    """Whether a path has a placeholder for a frame."""
    return bool(_FRAME.search(path))


def as_expression(path: str) -> str | None:
    """A path with environment variables as an expression; None if it has none, or can be none."""
    if '"' in path or "`" in path:
        return None
    frames = {each.start() for each in _FRAME.finditer(path)}

    def variable(found: re.Match[str]) -> str:
        name = next(filter(None, found.groups()))
        return found.group() if found.start() in frames else f"${{{name}}}"

    expression = _VARIABLE.sub(variable, path)
    variables = (each for each in _VARIABLE.finditer(path) if each.start() not in frames)
    return f'`"{expression}"`' if any(variables) else None


def matching_frames(pattern: str, names: Iterable[str]) -> list[Frame]:
    """The names that a file name with a frame placeholder stands for, by their frame numbers."""
    found = _FRAME.search(pattern)
    if found is None:
        return []
    width = next((digits for digits in found.groups() if digits), "").lstrip("0") or "1"
    if found.group()[0] in "#@":
        width = str(len(found.group()))
    if len(width) > len(str(LONGEST_NUMBER)) or int(width) > LONGEST_NUMBER:
        return []
    before, after = map(re.escape, (pattern[: found.start()], pattern[found.end() :]))
    name_of = re.compile(rf"{before}(-?\d{{{width},{LONGEST_NUMBER}}}){after}")
    matches = map(name_of.fullmatch, names)
    return sorted(Frame(int(match[1]), match[0]) for match in matches if match)
