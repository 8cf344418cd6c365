"""File names that end in a frame number, and the files on disk that differ in it alone."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import NamedTuple

_NUMBERED = re.compile(r"(?s)(.*(?<![0-9]))([0-9]{3,7})(\.[A-Za-z]\w*)")
_NUMBER_LOST = re.compile(r"(?s)(.*[._-])()(\.[A-Za-z]\w*)")
_WORD = re.compile(r"([A-Z]?[a-z]+|[A-Z]+)[^A-Za-z0-9]*$")
_ISSUES = "v|vers?|version|r|rev|revision|release|take|shot"
_ISSUE = re.compile(_ISSUES, re.IGNORECASE)
"""Words before the number of a version or shot."""
_NO_FRAMES = re.compile(
    rf"{_ISSUES}|lod|level|lvl|mip|x|res|resolution|wedge|seed"
    r"|iter|iteration|var|variant|variation|alt|option|tile|udim|part|piece|chunk|cluster|id|idx"
    r"|index|type|kind|asset|cam|model|style|preset|sample|opt|num|img",
    re.IGNORECASE,
)
"""Words before a number that is no frame's."""
_LONGEST_NAME = 1024
"""No file system has longer names, but a path may."""
LONGEST_NUMBER = 255
"""The digits of the longest number that a file's name may have; a prim's may have more."""


class FrameName(NamedTuple):
    """A file name around its frame number; `digits` is "" where the number got lost."""

    before: str
    digits: str
    after: str

    @property
    def number(self) -> int:
        return int(self.digits)

    @property
    def has_dots(self) -> bool:
        """Whether the number stands, or should stand, between dots."""
        return self.before.endswith(".")

    def among(self, names: Iterable[str]) -> dict[int, str]:
        """The names that differ from this one in the number alone, by their numbers."""
        width = len(self.digits)
        longer = rf"[1-9][0-9]{{{width},{LONGEST_NUMBER}}}"
        number = rf"[0-9]{{{width}}}|{longer}" if width else rf"[0-9]{{1,{LONGEST_NUMBER}}}"
        alike = re.compile(f"{re.escape(self.before)}({number}){re.escape(self.after)}").fullmatch
        return {int(found[1]): found[0] for found in map(alike, names) if found}


def read_frame_name(name: str) -> FrameName | None:
    """A name that ends in a number of three digits or more, unless a word says it is no frame."""
    found = _NUMBERED.fullmatch(name) if len(name) <= _LONGEST_NAME else None
    if found is None:
        return None
    return None if _ends_in(_NO_FRAMES, found[1]) else FrameName(*found.groups())


def numbers_an_issue(before: str) -> bool:
    """Whether what stands before a number says that it is that of a version or shot."""
    return _ends_in(_ISSUE, before)


def _ends_in(words: re.Pattern[str], before: str) -> bool:
    word = _WORD.search(before[-_LONGEST_NAME:])
    return bool(word and words.fullmatch(word[1]))


def read_lost_number(name: str) -> FrameName | None:
    """A name that ends in what stands before a number, as `smoke..vdb` does."""
    found = _NUMBER_LOST.fullmatch(name) if len(name) <= _LONGEST_NAME else None
    return FrameName(*found.groups()) if found else None
