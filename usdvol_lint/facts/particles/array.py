"""One array of a particle field: its samples, and the elements in it that have something wrong."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from functools import cached_property
from math import inf
from typing import Any, NamedTuple

from pxr import Usd

from usdvol_lint.facts.particles import matches
from usdvol_lint.facts.particles.chunks import Row, Rows, rows_of
from usdvol_lint.facts.particles.counts import NO_COUNTS
from usdvol_lint.facts.particles.elements import Elements
from usdvol_lint.facts.particles.matches import Mask, Matches
from usdvol_lint.facts.particles.ranges import (
    Range,
    column_range,
    counted_column_range,
    finiteness,
    joined,
    norm_range,
)
from usdvol_lint.facts.usd.steps import StepSamples, Time
from usdvol_lint.facts.usd.values import Value

_NO_NORM = 1e-12
"""A square: a quaternion that is shorter can not be made a unit one."""

_NOUNS = {"radiance:sphericalHarmonicsCoefficients": "coefficients"}
_MEASURES = {"orientations": norm_range, "coefficients": finiteness}
_COUNTED = frozenset({"scales", "opacities"})


class ArraySample(NamedTuple):
    """One value of an array; `time` is None for the default, `size` 0 where there is nothing."""

    time: Time
    size: int


class ParticleArray:
    """An array attribute with the samples that are looked at, the default first.

    `float_name` is the name of the float array of its pair, `noun` what its elements are called;
    it `is_populated` if there is an element at some time.
    `total` is how many time samples it has; values are read again for each question that takes
    all of them, so that no more than one is in memory; `with_counts` has the numbers counted by
    size where a distribution means something.
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
        self.is_populated = any(sample.size for sample in samples)
        self.total = total
        self.sizes = StepSamples(samples)
        self._with_counts = with_counts
        self._counts = NO_COUNTS
        self._advance = advance

    @property
    def begins_populated(self) -> bool:
        """Whether there is one at USD's earliest time."""
        return bool(self.sizes.at(-inf))

    @cached_property
    def ranges(self) -> tuple[tuple[ArraySample, Range], ...]:
        """The range of each column in each sample; of orientations that of their squared norms.

        Of coefficients, most of the data, there is none: they may have any value that is finite.
        """
        measure = _MEASURES.get(self.noun, column_range)
        if self._with_counts and self.noun in _COUNTED:
            measure = counted_column_range
        ranges = []
        for sample, rows in self.read():
            found = measure(rows)
            if found.counts is not None:  # half a megabyte, too much to keep for each sample
                self._counts = self._counts + found.counts
                found = replace(found, counts=None)
            ranges.append((sample, found))
        return tuple(ranges)

    @property
    def counts(self) -> Rows:
        """How often each number occurs in all samples together, if that was asked for."""
        assert self.ranges
        return self._counts

    @property
    def low(self) -> Row | None:
        """The least finite number in each column."""
        return joined(min, (found.low for _, found in self.ranges))

    @property
    def high(self) -> Row | None:
        """The greatest finite number in each column."""
        return joined(max, (found.high for _, found in self.ranges))

    @property
    def has_nan(self) -> bool:
        return any(found.has_nan for _, found in self.ranges)

    @property
    def has_infinity(self) -> bool:
        return any(found.has_infinity for _, found in self.ranges)

    def non_finite(self) -> Elements | None:
        """The elements with NaN or infinity in them."""
        return self._elements((sample, found.non_finite) for sample, found in self.ranges)

    def outside(self, low: float, high: float) -> Elements | None:
        """The elements with a finite number outside of the limits."""
        return self._suspects(
            lambda least, greatest: min(least) < low or max(greatest) > high,
            lambda chunk, _: matches.outside(chunk, low, high),
        )

    def without_direction(self) -> Elements | None:
        """The quaternions of no length, or next to none."""
        return self._suspects(
            lambda least, _: least[0] < _NO_NORM,
            lambda chunk, _: matches.squared_norms(chunk) < _NO_NORM,
        )

    def not_unit(self, tolerance: float) -> Elements | None:
        """The other quaternions whose length is not 1."""
        low, high = (1 - tolerance) ** 2, (1 + tolerance) ** 2

        def mask(chunk: Rows, start: int) -> Rows:
            norms = matches.squared_norms(chunk)
            picked: Rows = ((norms < low) & (norms >= _NO_NORM)) | (norms > high)
            return picked & matches.is_finite(chunk)

        return self._suspects(lambda least, most: least[0] < low or most[0] > high, mask)

    def zeros(self, axes: int = 1) -> Elements | None:
        """The elements in which so many numbers, or more, are zero."""
        return self._suspects(
            lambda least, _: sum(number <= 0 for number in least) >= axes,
            lambda chunk, _: (chunk == 0).sum(axis=1) >= axes,
        )

    def repetitions(self) -> Elements | None:
        """The elements that are the same as the one after them."""
        return self._elements(
            (sample, matches.repetitions(rows)) for sample, rows in self.read() if sample.size > 1
        )

    def picked(self, masks: Mapping[Time, Mask]) -> Elements | None:
        """The elements that a mask picks, which may be another for each sample."""
        return self._elements(
            (sample, matches.find_matches(rows, masks[sample.time]))
            for sample, rows in self.read(lambda sample: sample.time in masks)
        )

    def read(
        self, wanted: Callable[[ArraySample], bool] = lambda sample: True
    ) -> Iterator[tuple[ArraySample, Rows]]:
        """The samples that hold something, one after the other."""
        get = Usd.AttributeQuery(self.attribute).Get
        for sample in self.samples:
            if sample.size and wanted(sample):
                value = self.attribute.Get() if sample.time is None else get(sample.time)
                yield sample, rows_of(value)
                self._advance(1)

    def _suspects(self, is_suspect: Callable[[Row, Row], bool], mask: Mask) -> Elements | None:
        """The elements that a mask picks; reads only what has a suspicious range."""
        times = {
            sample.time
            for sample, found in self.ranges
            if found.low and found.high and is_suspect(found.low, found.high)
        }
        return self.picked(dict.fromkeys(times, mask)) if times else None

    def _elements(self, matched: Iterable[tuple[ArraySample, Matches | None]]) -> Elements | None:
        found = [(sample, rows) for sample, rows in matched if rows]
        if not found:
            return None
        values = tuple(Value(sample.time, rows) for sample, rows in found)
        sizes = tuple(sample.size for sample, _ in found)
        return Elements(self.attribute, values, self.total, sizes, self.noun)
