"""One array of a particle field: its samples, their ranges, and the elements out of range."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from math import inf
from operator import attrgetter
from typing import Any, NamedTuple

import numpy as np
from pxr import Usd

from usdvol_lint.cached import cached_property
from usdvol_lint.facts.particles import matches
from usdvol_lint.facts.particles.chunks import Row, Rows, rows_of
from usdvol_lint.facts.particles.counts import NO_COUNTS
from usdvol_lint.facts.particles.elements import Elements, as_text
from usdvol_lint.facts.particles.matches import Mask, Matches
from usdvol_lint.facts.particles.ranges import (
    Range,
    column_range,
    counted_column_range,
    finiteness,
    joined,
    norm_range,
)
from usdvol_lint.facts.usd.clips import is_from_clips
from usdvol_lint.facts.usd.steps import StepSamples, Time
from usdvol_lint.facts.usd.values import Value, Values

_NO_NORM = 1e-12
"""The least squared length of a quaternion that can still be normalised."""

_NOUNS = {"radiance:sphericalHarmonicsCoefficients": "coefficients"}
_MEASURES = {"orientations": norm_range, "coefficients": finiteness}
_COUNTED = frozenset({"scales", "opacities"})


class ArraySample(NamedTuple):
    """One value of an array: its time, None for the default, and its size, 0 where it is None.

    `is_blocked`: whether it is None, so that nothing is authored at that time.
    """

    time: Time
    size: int
    is_blocked: bool = False


class ParticleArray:
    """An array attribute with the samples that are to be checked, the default first.

    `float_name` is the name of the float array of its pair, `noun` what its elements are called.
    `most` is the greatest number of elements of a sample.
    `total` is how many time samples USD has; `is_read_whole` says that these are all of them.
    It `is_populated` if a sample has elements; the default is one only where no time sample is.
    Values are read anew for each question about all of them, so that one at a time is in memory.
    `with_counts` makes a histogram of scales and of opacities while their ranges are found.
    """

    def __init__(
        self,
        attribute: Any,
        samples: tuple[ArraySample, ...],
        total: int,
        with_counts: bool = False,
        advance: Callable[[int], None] = lambda count: None,
    ) -> None:
        self.attribute = attribute
        self.name = str(attribute.GetName())
        self.float_name = self.name.removesuffix("h")
        self.is_half = self.name != self.float_name
        self.noun = _NOUNS.get(self.float_name, self.float_name)
        self.samples = samples
        self.most = max((sample.size for sample in samples), default=0)
        self.total = total
        timed = [sample.size for sample in samples if sample.time is not None]
        self.is_read_whole = total == len(timed)
        self.is_populated = any(timed) if timed and self.is_read_whole else self.most > 0
        sizes = ((each.time, None if each.is_blocked else each.size) for each in samples)
        self.sizes = StepSamples(sizes)
        self._with_counts = with_counts
        self._advance = advance

    @property
    def begins_populated(self) -> bool:
        """Whether there is an element at USD's earliest time."""
        return bool(self.sizes.at(-inf))

    @property
    def is_from_clips(self) -> bool:
        """Whether its first time sample is one of value clips."""
        return is_from_clips(self.attribute)

    @property
    def ranges(self) -> tuple[tuple[ArraySample, Range], ...]:
        """The range of each column in each sample; of orientations that of their squared norms.

        Coefficients, most of the data, have none: any finite number is allowed there.
        """
        return self._measured[0]

    @property
    def counts(self) -> Rows:
        """How often each number occurs in all samples together; zeros unless `with_counts`."""
        return self._measured[1]

    @cached_property
    def _measured(self) -> tuple[tuple[tuple[ArraySample, Range], ...], Rows]:
        """The ranges and the counts, found in one pass over the samples."""
        measure = _MEASURES.get(self.noun, column_range)
        if self._with_counts and self.noun in _COUNTED:
            measure = counted_column_range
        ranges, counts = [], NO_COUNTS
        for sample, rows in self.read():
            measured = measure(rows)
            if measured.counts is not None:  # half a megabyte, too much to keep for each sample
                counts = counts + measured.counts
                measured = measured._replace(counts=None)
            ranges.append((sample, measured))
        return tuple(ranges), counts

    @property
    def low(self) -> Row | None:
        """The least finite number in each column."""
        return joined(min, (measured.low for _, measured in self.ranges))

    @property
    def high(self) -> Row | None:
        """The greatest finite number in each column."""
        return joined(max, (measured.high for _, measured in self.ranges))

    @property
    def span(self) -> tuple[float, float] | None:
        """The least and the greatest finite number in all columns."""
        low, high = self.low, self.high
        return (min(low), max(high)) if low and high else None

    @property
    def shown_span(self) -> str:
        """The least and the greatest finite number in each column as messages show them, or ""."""
        low, high = self.low, self.high
        return f"{as_text(low)} to {as_text(high)}" if low and high else ""

    @property
    def has_nan(self) -> bool:
        return any(measured.has_nan for _, measured in self.ranges)

    @property
    def has_infinity(self) -> bool:
        return any(measured.has_infinity for _, measured in self.ranges)

    def non_finite(self) -> Elements | None:
        """The elements that contain NaN or infinity."""
        return self._elements((sample, measured.non_finite) for sample, measured in self.ranges)

    def spoils(self, extents: Values) -> bool:
        """Whether these are positions that are not finite whenever one of the extents is not."""
        held = dict(extents.grouped(attrgetter("is_finite"))).get(False)
        found = self.non_finite() if held and self.noun == "positions" else None
        return bool(held and found and found.include_times_of(held))

    def outside(self, low: float, high: float) -> Elements | None:
        """The elements with a finite number outside of the limits."""
        return self._search(
            lambda least, greatest: min(least) < low or max(greatest) > high,
            lambda chunk, _: matches.outside(chunk, low, high),
        )

    def without_direction(self) -> Elements | None:
        """The quaternions too short to be normalised."""
        return self._search(
            lambda least, _: least[0] < _NO_NORM,
            lambda chunk, _: matches.squared_norms(chunk) < _NO_NORM,
        )

    def not_unit(self, tolerance: float) -> Elements | None:
        """The quaternions whose length is not 1, without those that can't be normalised."""
        low, high = (1 - tolerance) ** 2, (1 + tolerance) ** 2

        def mask(chunk: Rows, start: int) -> Rows:
            norms = matches.squared_norms(chunk)
            selected: Rows = ((norms < low) & (norms >= _NO_NORM)) | (norms > high)
            return selected & matches.is_finite(chunk)

        return self._search(lambda least, greatest: least[0] < low or greatest[0] > high, mask)

    def faint(self, limit: float, wanted: Callable[[ArraySample], bool]) -> Rows:
        """Which elements are as close to 0 as `limit` in all wanted samples."""
        return self._always(
            lambda least: least[0] <= limit, lambda chunk, _: np.abs(chunk[:, 0]) <= limit, wanted
        )

    def without_size(self, wanted: Callable[[ArraySample], bool]) -> Rows:
        """Which elements have two numbers that are zero, in all wanted samples."""
        return self._always(
            lambda least: sum(number <= 0 for number in least) > 1,
            lambda chunk, _: (chunk == 0).sum(axis=1) > 1,
            wanted,
        )

    def selected(self, makers: Mapping[Time, Callable[[ArraySample], Mask]]) -> Elements | None:
        """The elements that masks select, each made for its sample; others are not read."""
        return self._elements(
            (sample, matches.find_matches(rows, makers[sample.time](sample)))
            for sample, rows in self.read(lambda sample: sample.time in makers)
        )

    def read(
        self, wanted: Callable[[ArraySample], bool] = lambda sample: True
    ) -> Iterator[tuple[ArraySample, Rows]]:
        """Reads the samples that have elements, one after the other."""
        get = Usd.AttributeQuery(self.attribute).Get
        for sample in self.samples:
            if sample.size and wanted(sample):
                value = self.attribute.Get() if sample.time is None else get(sample.time)
                yield sample, rows_of(value)
                self._advance(1)

    def _always(
        self,
        is_suspect: Callable[[Row], bool],
        mask: Mask,
        wanted: Callable[[ArraySample], bool],
    ) -> Rows:
        """Which elements a mask selects in all wanted samples that have them: a boolean for each.

        Only samples whose least numbers are suspicious are read, and only while some elements are
        left; none are where a sample as long as the longest is above suspicion.
        """
        most = max((sample.size for sample in self.samples if wanted(sample)), default=0)
        cleared = [
            sample.size
            for sample, measured in self.ranges
            if wanted(sample) and not (measured.low and is_suspect(measured.low))
        ]
        left: Rows = np.ones(0 if most in cleared else most, np.bool_)
        left[: max(cleared, default=0)] = False
        for _, rows in self.read(lambda own: wanted(own) and bool(left[: own.size].any())):
            matches.keep(left, rows, mask)
        return left

    def _search(self, is_suspect: Callable[[Row, Row], bool], mask: Mask) -> Elements | None:
        """The elements that a mask selects; reads only the samples whose range is suspicious."""
        times = {
            sample.time
            for sample, measured in self.ranges
            if measured.low and measured.high and is_suspect(measured.low, measured.high)
        }
        return self.selected(dict.fromkeys(times, lambda sample: mask)) if times else None

    def _elements(self, matched: Iterable[tuple[ArraySample, Matches | None]]) -> Elements | None:
        present = [(sample, rows) for sample, rows in matched if rows]
        if not present:
            return None
        values = tuple(Value(sample.time, rows) for sample, rows in present)
        sizes = tuple(sample.size for sample, _ in present)
        return Elements(self.attribute, values, self.total, sizes, self.noun)
