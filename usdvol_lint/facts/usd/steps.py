"""Held (step) interpolation, which USD uses for types that it can't interpolate."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable
from typing import Generic, TypeAlias, TypeVar

_T = TypeVar("_T")

Time: TypeAlias = float | None
"""A time code of the stage, or None for the default time."""


class StepSamples(Generic[_T]):
    """Samples, of an attribute or derived from one, that each hold until the next.

    `samples` ascend in time, with the default, if there is one, first.
    """

    def __init__(self, samples: Iterable[tuple[Time, _T]]) -> None:
        self.default: _T | None = None
        self.times: list[float] = []
        self._values: list[_T] = []
        for time, value in samples:
            if time is None:
                self.default = value
            else:
                self.times.append(time)
                self._values.append(value)

    def at(self, time: Time) -> _T | None:
        """The value at a time: the first sample holds backwards too, and samples hide a default."""
        if time is None or not self.times:
            return self.default
        return self._values[max(bisect_right(self.times, time) - 1, 0)]
