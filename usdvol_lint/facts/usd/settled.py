"""Values that hang on one another, found without recursion: chains may be of any length."""

from __future__ import annotations

from collections.abc import Callable, Generator, Hashable
from typing import TypeVar

_K = TypeVar("_K", bound=Hashable)
_V = TypeVar("_V")


def settle(key: _K, find: Callable[[_K], Generator[_K, None, _V]], known: dict[_K, _V]) -> _V:
    """The value of a key; it and all that it hangs on are added to `known`.

    `find` yields each key that it needs and that is not known, which then is, and returns a value.
    """
    waiting = [] if key in known else [(key, find(key))]
    while waiting:
        current, steps = waiting[-1]
        try:
            needed = next(steps)
        except StopIteration as end:
            known[current] = end.value
            waiting.pop()
        else:
            waiting.append((needed, find(needed)))
    return known[key]
