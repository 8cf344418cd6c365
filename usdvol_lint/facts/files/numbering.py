"""The frame numbers in the paths of a sequence."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from itertools import islice, pairwise
from typing import NamedTuple

_DIGITS = re.compile(r"([0-9]+)")
_NUMBERS = (re.compile(r"-?[0-9]+"), re.compile(r"-?[0-9]+\.[0-9]+"))  # whole frames, sub-frames
_NO_NUMBER = math.nan


class Numbering(NamedTuple):
    """The frame number in each path of a sequence.

    `numbers` has one for each path, NaN if it has none; `groups` are the positions of the number
    among the groups of digits in a path.
    """

    numbers: list[float]
    groups: tuple[int, ...]

    def renumbered(self, path: str, number: float) -> str | None:
        """A path of the sequence with another frame number, padded like its own.

        None if the number is negative or no integer.
        """
        number = round(number, 3)
        if number < 0 or not number.is_integer():
            return None
        parts = _DIGITS.split(path)
        for group in self.groups:
            width = len(parts[2 * group + 1])
            parts[2 * group + 1] = f"{int(number):0{width}}"
        return "".join(parts)


def find_numbering(paths: Sequence[str]) -> Numbering | None:
    """The last number that varies, or None; most paths must differ in nothing but numbers."""
    return _only_difference(paths) or _difference_of_most(paths)


def _only_difference(paths: Sequence[str]) -> Numbering | None:
    """The number, if the paths differ in nothing else: the usual case, and quick to see."""
    low, high = min(paths), max(paths)
    pairs = enumerate(zip(low, high, strict=False))
    same = next((index for index, (a, b) in pairs if a != b), len(low))
    before = len(low[:same].rstrip("0123456789"))
    for pattern in _NUMBERS:
        found = pattern.match(low, before)
        if found is None or low == high:
            break
        after = len(low) - found.end()
        numbers = [path[before : len(path) - after] for path in paths]
        ends = {path[-after:] for path in paths} if after else {""}
        if len(ends) == 1 and _are_numbers(numbers):
            group = len(_DIGITS.findall(low, 0, before))
            return Numbering(list(map(float, numbers)), (group,))
    return None


def _are_numbers(texts: Sequence[str]) -> bool:
    joined = "".join(texts)
    if joined.isascii() and joined.isdecimal() and all(texts):  # nearly always, and quick
        return True
    return all(any(pattern.fullmatch(text) for pattern in _NUMBERS) for text in texts)


def _difference_of_most(paths: Sequence[str]) -> Numbering | None:
    """The number that differs in two neighbouring paths, if most of the paths are like them.

    The neighbours are taken from the middle: a rest frame may come first.
    """
    neighbours = pairwise(islice(paths, len(paths) // 2 - 1, None))
    one, other = next((pair for pair in neighbours if pair[0] != pair[1]), ("", ""))
    parts, others = _DIGITS.split(one), _DIGITS.split(other)
    pairs = enumerate(zip(parts, others, strict=False))
    differing = [index for index, (part, other_part) in pairs if part != other_part]
    # What `split` puts at odd positions are the groups of digits.
    if len(parts) != len(others) or not differing or not all(index % 2 for index in differing):
        return None
    last = differing[-1]
    pattern = [re.escape(part) for part in parts]
    for index in differing:
        pattern[index] = "([0-9]+)" if index == last else "[0-9]+"
    matches = list(map(re.compile("".join(pattern)).fullmatch, paths))
    if matches.count(None) * 5 > len(paths):
        return None
    numbers = [float(match[1]) if match else _NO_NUMBER for match in matches]
    equal = [index // 2 for index in differing if parts[index] == parts[last]]
    return Numbering(numbers, tuple(equal))
