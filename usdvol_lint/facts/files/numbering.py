"""The frame numbers in the paths of a sequence."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from itertools import islice, pairwise
from typing import NamedTuple

_DIGITS = re.compile(r"([0-9]+)")
_NUMBERS = (re.compile(r"-?[0-9]+"), re.compile(r"-?[0-9]+\.[0-9]+"))  # the latter: sub-frames
_NO_NUMBER = math.nan


class Numbering(NamedTuple):
    """The number in each path, NaN where there is none, and which of its digit groups hold it."""

    numbers: list[float]
    groups: tuple[int, ...]

    def renumbered(self, path: str, number: float) -> str | None:
        """A path of the sequence with another number in it, as wide as its own.

        None for a number below 0 or between two frames.
        """
        number = round(number, 3)
        if number < 0 or not number.is_integer():
            return None
        parts = _DIGITS.split(path)
        for group in self.groups:
            width = len(parts[2 * group + 1])
            parts[2 * group + 1] = f"{int(number):0{width}}"
        return "".join(parts)


def number(paths: Sequence[str]) -> Numbering | None:
    """The last number that varies in the paths; most of them must be alike but for numbers."""
    return _number_that_alone_differs(paths) or _number_of_most(paths)


def _number_that_alone_differs(paths: Sequence[str]) -> Numbering | None:
    """Quick, and enough for a sequence whose paths differ in one number and nothing else."""
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
    if joined.isascii() and joined.isdecimal() and all(texts):  # nearly always, and at once
        return True
    return all(any(pattern.fullmatch(text) for pattern in _NUMBERS) for text in texts)


def _number_of_most(paths: Sequence[str]) -> Numbering | None:
    """What two neighbours in the middle differ in, where most other paths are like them."""
    neighbours = pairwise(islice(paths, len(paths) // 2 - 1, None))
    one, other = next((pair for pair in neighbours if pair[0] != pair[1]), ("", ""))
    parts, others = _DIGITS.split(one), _DIGITS.split(other)
    places = [
        place for place, pair in enumerate(zip(parts, others, strict=False)) if len({*pair}) > 1
    ]
    if len(parts) != len(others) or not places or not all(place % 2 for place in places):
        return None
    last = places[-1]
    shape = [re.escape(part) for part in parts]
    for place in places:
        shape[place] = "([0-9]+)" if place == last else "[0-9]+"
    found = list(map(re.compile("".join(shape)).fullmatch, paths))
    if found.count(None) * 5 > len(paths):
        return None
    numbers = [float(match[1]) if match else _NO_NUMBER for match in found]
    same = [place // 2 for place in places if parts[place] == parts[last]]
    return Numbering(numbers, tuple(same))
