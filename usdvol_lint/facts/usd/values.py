"""All values of an attribute: the default, time samples, and samples in value clips."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, NamedTuple

from pxr import Usd

from usdvol_lint.facts.usd.calls import count_samples, get_value
from usdvol_lint.facts.usd.retimes import reaching_samples


class Value(NamedTuple):
    """One value of an attribute; `time` is None for the default."""

    time: float | None
    value: Any


@dataclass(frozen=True, slots=True)
class Occurrences:
    """Some of an attribute's values, which rules hand on as an `Occurrence`.

    `samples` ascend in `time`, with that of the default time (None) first; what is reported has at
    least one.  `total` is the number of the attribute's time samples.
    """

    attribute: Any
    samples: tuple[Any, ...]
    total: int

    @property
    def times(self) -> tuple[float, ...]:
        """The time codes of the stage, without the default time."""
        return tuple(sample.time for sample in self.samples if sample.time is not None)

    @property
    def at_default(self) -> bool:
        """Whether the default is one of the values."""
        return self.samples[0].time is None

    def include_times_of(self, others: Occurrences) -> bool:
        """Whether there is one of these at each time, the default too, at which others are."""
        return {each.time for each in others.samples} <= {each.time for each in self.samples}

    @property
    def asset(self) -> str | None:
        """The authored asset path whose line a finding should point to."""
        return None

    @property
    def count(self) -> str:
        """Which share of the time samples these are: ` (4 of 240 samples)`, or "" without any."""
        if self.total == 0:
            return ""
        times = self.times
        if not times:
            return f" (the default alone, none of the {self.total} time samples)"
        return f" ({', '.join([f'{len(times)} of {self.total} samples', *self._more(times)])})"

    def _more(self, times: Sequence[float]) -> Iterator[str]:
        """Further phrases for `count`, if there are `times`."""
        yield from ()


@dataclass(frozen=True, slots=True)
class Values(Occurrences):
    """Some of an attribute's values, as USD returns them."""

    samples: tuple[Value, ...]

    def __iter__(self) -> Iterator[Any]:
        return (value for _, value in self.samples)

    def grouped(self, key: Callable[[Any], Any]) -> Iterator[tuple[Any, Values]]:
        """The values of each key, in the order of first values, without those whose key is None."""
        groups: dict[Any, list[Value]] = defaultdict(list)
        for sample in self.samples:
            group = key(sample.value)
            if group is not None:
                groups[group].append(sample)
        for group, samples in groups.items():
            yield group, Values(self.attribute, tuple(samples), self.total)


def values_of(attribute: Any) -> Values:
    """All values of an attribute, in memory at once; a default of None if it has none."""
    if not count_samples(attribute):
        return Values(attribute, (Value(None, get_value(attribute)),), 0)
    values = tuple(read_values(attribute))
    return Values(attribute, values, len(values) - (values[0].time is None))


def read_values(attribute: Any) -> Iterator[Value]:
    """Yields the default, then each sample as it is read; a default of None if there is neither."""
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
    """The time codes of the stage at which an attribute has samples, those in clips included."""
    if not count_samples(attribute):
        return []
    times: list[float] = attribute.GetTimeSamples()
    # Where a clip begins, USD adds a sample a hair before it that repeats the last value.
    apart = [
        time
        for time, following in pairwise(times)
        if following - time >= 1e-6 * max(1.0, abs(time))
    ]
    return reaching_samples(attribute, apart + times[-1:])
