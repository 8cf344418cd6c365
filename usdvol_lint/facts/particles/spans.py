"""From when to when the arrays of a particle field have samples, beside a time range."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from operator import sub
from typing import Any

from pxr import Usd

from usdvol_lint.cached import cached_property
from usdvol_lint.facts.particles.array import ParticleArray
from usdvol_lint.facts.usd.moving import advice_on_shift, rate_at_fault
from usdvol_lint.facts.usd.values import sample_times
from usdvol_lint.facts.usd.visibility import is_hidden
from usdvol_lint.words import format_time


class Span:
    """Arrays whose samples, at least two, begin at one time and end at one time.

    `times` are those of the first array, which stands for the others.
    """

    def __init__(self, array: ParticleArray, times: Sequence[float]) -> None:
        self.arrays = [array]
        self.attribute = array.attribute
        self.times = times
        self.first, self.last = times[0], times[-1]

    @property
    def names(self) -> str:
        """The names of the arrays."""
        return ", ".join(repr(array.name) for array in self.arrays)

    @cached_property
    def step(self) -> float:
        """The time from one sample to the next, of most of them."""
        steps: list[float] = sorted(map(sub, self.times[1:], self.times))
        return steps[len(steps) // 2]

    @property
    def is_animated(self) -> bool:
        """Whether two of the samples of an array differ."""
        return any(map(_differ, self.arrays))

    def is_outside(self, time_range: tuple[float, float]) -> bool:
        """Whether all samples are before a time range, or after it."""
        return self.last < time_range[0] or self.first > time_range[1]

    def held(self, time_range: tuple[float, float]) -> Iterator[tuple[str, tuple[float, float]]]:
        """What is shown where they do not cover a time range, in words, and when.

        A sample holds until the next would come.  That one without elements is held is told only
        of a whole range: there are no particles before they come, and after they died.
        """
        start, end = time_range
        sizes = self.arrays[0].sizes
        if self.is_outside(time_range):
            which, time = ("last", self.last) if self.last < start else ("first", self.first)
            empty = "" if sizes.at(time) else ", without elements,"
            yield f"the {which} one{empty} is held throughout", (start, end)
            return
        if self.first - start > self.step - 1e-6 and sizes.at(self.first):
            words = f"the first one is held until {format_time(self.first)}"
            yield words, (start, self.first - 1e-6)
        if end - self.last > self.step - 1e-6 and sizes.at(self.last):
            words = f"the last one is held from {format_time(self.last)} on"
            yield words, (self.last + self.step, end)

    def is_hidden(self, times: tuple[float, float]) -> bool:
        """Whether the particle field is invisible from one time to the other."""
        return is_hidden(self.attribute.GetPrim(), (), times, between=True)

    def advice_on_shift(self, start: float) -> str:
        """How to move the samples to where a range starts."""
        return advice_on_shift(self.attribute, self.first, start - self.first)

    def rate_at_fault(self, time_range: tuple[float, float]) -> str | None:
        """The scale of a rate, in words, but for which the samples would cover a time range."""
        return rate_at_fault(self.attribute, (self.first, self.last), self.step, time_range)


def spans_of(arrays: Iterable[ParticleArray]) -> list[Span]:
    """The arrays with several samples, those that begin and end with each other together."""
    spans: dict[tuple[float, float], Span] = {}
    for array in arrays:
        times = sample_times(array.attribute)
        if len(times) > 1:
            found = spans.setdefault((times[0], times[-1]), Span(array, times))
            if array not in found.arrays:
                found.arrays.append(array)
    return list(spans.values())


def _differ(array: ParticleArray) -> bool:
    """Whether two of an array's samples differ; most often the first two do."""
    get: Any = Usd.AttributeQuery(array.attribute).Get
    first, *others = sample_times(array.attribute)
    value = get(first)
    return any(get(time) != value for time in others)
