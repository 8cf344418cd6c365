"""Every value that USD gives for an attribute: the default, time samples, value clips."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, NamedTuple

from pxr import Usd

from usdvol_lint.facts.usd.calls import count_samples, get_value


class Value(NamedTuple):
    """One value of an attribute; `time` is None for the default."""

    time: float | None
    value: Any


@dataclass(frozen=True, slots=True)
class Occurrences:
    """Where something stands in the values of an attribute: `Occurrence`, as rules hand it on.

    `samples` are never none, in ascending time, the default first; each has its `time`.
    `total` is how many time samples the attribute has.
    """

    attribute: Any
    samples: tuple[Any, ...]
    total: int

    @property
    def times(self) -> tuple[float, ...]:
        """The stage times, without the default."""
        return tuple(each.time for each in self.samples if each.time is not None)

    @property
    def at_default(self) -> bool:
        return self.samples[0].time is None

    @property
    def asset(self) -> str | None:
        """The asset path that the line should point to, as authored."""
        return None

    @property
    def count(self) -> str:
        """Empty for a single value, else ` (4 of 240 samples)`."""
        if self.total == 0:
            return ""
        times = self.times
        if not times:
            return f" (the default alone, none of the {self.total} time samples)"
        return f" ({', '.join([f'{len(times)} of {self.total} samples', *self._more(times)])})"

    def _more(self, times: Sequence[float]) -> Iterator[str]:
        """What else to say where some of the time samples are meant."""
        yield from ()


@dataclass(frozen=True, slots=True)
class Values(Occurrences):
    """Some of an attribute's values."""

    samples: tuple[Value, ...]

    def __iter__(self) -> Iterator[Any]:
        return (value for _, value in self.samples)

    def grouped(self, key: Callable[[Any], Any]) -> Iterator[tuple[Any, Values]]:
        """The values apart for each key that they have, without those whose key is None."""
        found: dict[Any, list[Value]] = defaultdict(list)
        for value in self.samples:
            name = key(value.value)
            if name is not None:
                found[name].append(value)
        for name, values in found.items():
            yield name, Values(self.attribute, tuple(values), self.total)


def values_of(attribute: Any) -> Values:
    """Every value of an attribute, kept; the default is None where there is nothing at all."""
    if not count_samples(attribute):
        return Values(attribute, (Value(None, get_value(attribute)),), 0)
    values = tuple(read_values(attribute))
    return Values(attribute, values, len(values) - (values[0].time is None))


def read_values(attribute: Any) -> Iterator[Value]:
    """Reads the default and the samples; the default is None where there is nothing at all."""
    default = get_value(attribute)
    times = sample_times(attribute)
    if default is not None or not times:
        yield Value(None, default)
    if not times:
        return
    get = Usd.AttributeQuery(attribute).Get  # resolves the attribute once, not at every time
    for time in times:
        yield Value(time, get(time))


def sample_times(attribute: Any) -> list[float]:
    """The times at which an attribute has samples."""
    if not count_samples(attribute):
        return []
    times: list[float] = attribute.GetTimeSamples()
    # Where a clip begins, USD adds a sample a hair before it that repeats the last value.
    return [
        time
        for time, following in pairwise(times)
        if following - time >= 1e-6 * max(1.0, abs(time))
    ] + times[-1:]
