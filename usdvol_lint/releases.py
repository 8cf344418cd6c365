"""Numbers of releases: which one is later, and which ones a configuration wants."""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping
from itertools import takewhile
from typing import Any, TypeAlias

from usdvol_lint import __version__
from usdvol_lint.model import UsageError

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


def required_version(where: str, value: Any) -> str:
    """The value, if this version is among those that it wants; else raises UsageError."""
    try:
        is_this = is_wanted(__version__, value if isinstance(value, str) else "")
    except ValueError:
        wanted = "a text such as '>=0.1,<0.2', or '0.1' for that and its patches"
        raise UsageError(f"{where} must be {wanted}, not {value!r}") from None
    if not is_this:
        hint = "install one that is wanted, or change the key"
        raise UsageError(f"{where} is {value!r}, and this is usdvol-lint {__version__}: {hint}")
    return str(value)


def release(where: str, value: Any) -> str:
    """The value, if it is the number of a release; else raises UsageError."""
    try:
        numbers_of(value if isinstance(value, str) else "")
    except ValueError:
        wanted = "the number of a release as a text, such as '0.1'"
        raise UsageError(f"{where} must be {wanted}, not {value!r}") from None
    return str(value)


def numbers_of(number: str) -> Numbers:
    """The numbers of a release, of which zeros at the end say nothing: `0.1` is `0.1.0`.

    Raises ValueError for what is no number of a release.
    """
    numbers = list(_numbers(number))
    while numbers and not numbers[-1]:
        numbers.pop()
    return tuple(numbers)


def is_later(number: str, other: str) -> bool:
    """Whether a release came after another one."""
    return numbers_of(number) > numbers_of(other)


def is_wanted(number: str, wanted: str) -> bool:
    """Whether a release is among those wanted, by `>=0.1,<0.2`, or by `0.1`, that and its patches.

    What comes before a release, such as `0.2.0rc1`, counts as that release.
    Raises ValueError for what says no such thing.
    """
    ours = "".join(takewhile("0123456789.".__contains__, number)).rstrip(".")
    met = [_meets(ours, condition.strip()) for condition in wanted.split(",")]  # reads each
    return all(met)


def _meets(number: str, condition: str) -> bool:
    for sign, compare in _COMPARISONS.items():
        if condition.startswith(sign):
            return compare(numbers_of(number), numbers_of(condition.removeprefix(sign)))
    beginning = _numbers(condition)
    zeros = (0,) * len(beginning)
    return (*_numbers(number), *zeros)[: len(beginning)] == beginning


def _numbers(number: str) -> Numbers:
    names = number.strip().split(".")
    if not all(name.isascii() and name.isdigit() and len(name) <= _LONGEST for name in names):
        raise ValueError(f"{number!r} is no number of a release")
    return tuple(map(int, names))
