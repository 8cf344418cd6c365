"""Numbers of releases: which one is later, and whether one is among those that are wanted."""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping
from itertools import takewhile
from typing import TypeAlias

Numbers: TypeAlias = tuple[int, ...]

_COMPARISONS: Mapping[str, Callable[[Numbers, Numbers], bool]] = {
    ">=": operator.ge,
    "<=": operator.le,
    "==": operator.eq,
    "!=": operator.ne,
    ">": operator.gt,
    "<": operator.lt,
}
"""Two signs before one, which they begin with."""
_LONGEST = 9


def numbers_of(release: str) -> Numbers:
    """The numbers of a release, of which zeros at the end say nothing: `0.1` is `0.1.0`.

    Raises ValueError for what is no number of a release.
    """
    numbers = list(_numbers(release))
    while numbers and not numbers[-1]:
        numbers.pop()
    return tuple(numbers)


def is_later(release: str, other: str) -> bool:
    """Whether a release came after another one."""
    return numbers_of(release) > numbers_of(other)


def is_wanted(release: str, wanted: str) -> bool:
    """Whether a release is among those wanted, by `>=0.1,<0.2`, or by `0.1`, that and its patches.

    What comes before a release, such as `0.2.0rc1`, counts as that release.
    Raises ValueError for what says no such thing.
    """
    ours = "".join(takewhile("0123456789.".__contains__, release)).rstrip(".")
    met = [_meets(ours, condition.strip()) for condition in wanted.split(",")]  # reads each
    return all(met)


def _meets(release: str, condition: str) -> bool:
    for sign, compare in _COMPARISONS.items():
        if condition.startswith(sign):
            return compare(numbers_of(release), numbers_of(condition.removeprefix(sign)))
    beginning = _numbers(condition)
    zeros = (0,) * len(beginning)
    return (*_numbers(release), *zeros)[: len(beginning)] == beginning


def _numbers(release: str) -> Numbers:
    names = release.strip().split(".")
    if not all(name.isascii() and name.isdigit() and len(name) <= _LONGEST for name in names):
        raise ValueError(f"{release!r} is no number of a release")
    return tuple(map(int, names))
