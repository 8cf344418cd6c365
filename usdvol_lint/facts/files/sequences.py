"""The time samples of an asset attribute as a sequence: their step and their frame numbers."""

from __future__ import annotations

import math
import os
from bisect import bisect_left, bisect_right
from collections import Counter
from collections.abc import Iterable, Sequence
from operator import attrgetter, sub

from pxr import Ar

from usdvol_lint.cached import cached_property
from usdvol_lint.facts.files.assets import AssetSample, AssetSamples
from usdvol_lint.facts.files.numbering import Numbering, find_numbering
from usdvol_lint.facts.files.paths import split_path
from usdvol_lint.facts.files.states import AssetState

_NO_PATH = frozenset({AssetState.BROKEN_EXPRESSION, AssetState.UNSET_VARIABLE})


class SampleSequence:
    """The time samples of an asset attribute, at least two, in ascending time.

    Steps and numbers are found when first asked for.
    """

    def __init__(self, paths: AssetSamples, samples: Sequence[AssetSample]) -> None:
        self.paths = paths
        self.samples = samples
        self.times: list[float] = list(map(attrgetter("time"), samples))
        self._folders: dict[tuple[float | None, str], str] = {}

    @property
    def is_animated(self) -> bool:
        """Whether it names more than one file."""
        first = self.samples[0].path
        return any(sample.path != first for sample in self.samples)

    @property
    def holds_last(self) -> bool:
        """Whether the last sample names something, which is held after it; a block is not."""
        return self.samples[-1].state not in (AssetState.BLOCKED, AssetState.EMPTY)

    @property
    def holds_first(self) -> bool:
        """Whether the first sample names something, which is held before it; a block is not."""
        return self.samples[0].state not in (AssetState.BLOCKED, AssetState.EMPTY)

    @cached_property
    def numbering(self) -> Numbering | None:
        """The frame numbers in the paths, or None if no number varies."""
        if self.paths.states.isdisjoint(_NO_PATH):
            return find_numbering(list(map(attrgetter("path"), self.samples)))
        return find_numbering(["" if s.state in _NO_PATH else s.path for s in self.samples])

    @cached_property
    def steps(self) -> list[float]:
        """The times between neighbouring samples, rounded to 6 digits unless all are equal."""
        steps = list(map(sub, self.times[1:], self.times))
        return steps if len(set(steps)) == 1 else [round(step, 6) for step in steps]

    @cached_property
    def is_even(self) -> bool:
        """Whether all steps are equal."""
        return len(set(self.steps)) == 1

    @cached_property
    def step(self) -> float:
        """The most frequent step."""
        return self.steps[0] if self.is_even else most_frequent(self.steps)

    def far_off(self, time_range: tuple[float, float]) -> SampleSequence | None:
        """The samples outside of a time range that their frame numbers lie in, behind a long gap.

        None unless those within it, at least one, name one file, and these several.
        """
        start, end = time_range
        times, low, high = self.times, bisect_left(self.times, start), bisect_right(self.times, end)
        ends = ((low, self.samples[:low]), (high, self.samples[high:]))
        sides = [(index, samples) for index, samples in ends if samples]
        if low == high or len(sides) != 1:
            return None
        index, outside = sides[0]
        shown = {sample.path for sample in self.samples[low:high]}
        if times[index] - times[index - 1] <= end - start or len(shown) != 1 or "" in shown:
            return None
        found = SampleSequence(self.paths, outside)
        numbers = found.numbering.numbers if found.numbering else [math.nan]
        return found if all(start <= number <= end for number in numbers) else None

    def advice_on_shift(self, shift: float) -> str:
        """How to move the samples, wherever they are authored."""
        from usdvol_lint.facts.usd.moving import advice_on_shift

        return advice_on_shift(self.paths.attribute, self.times[0], shift)

    def rate_at_fault(self, time_range: tuple[float, float]) -> str | None:
        """The scale of a rate, in words, but for which the samples would cover a time range."""
        from usdvol_lint.facts.usd.moving import rate_at_fault

        ends = (self.times[0], self.times[-1])
        return rate_at_fault(self.paths.attribute, ends, self.step, time_range)

    def exists(self, sample: AssetSample, path: str) -> bool:
        """Whether there would be a file if the sample had this path."""
        folder, name = split_path(path)
        if sample.led_to and folder == split_path(sample.path)[0]:
            return os.path.isfile(f"{os.path.dirname(sample.led_to)}/{name}")
        key = (sample.time, folder)
        if key not in self._folders:
            anchored = self.paths.anchored(sample._replace(path=path, led_to=""))
            if Ar.IsPackageRelativePath(anchored):
                return bool(Ar.GetResolver().Resolve(anchored))
            self._folders[key] = os.path.dirname(anchored)
        return os.path.isfile(f"{self._folders[key]}/{name}")


def read_sequence(paths: AssetSamples) -> SampleSequence | None:
    """The time samples as a sequence, or None if there are fewer than two."""
    samples = paths.samples
    timed = samples[1:] if samples and samples[0].time is None else samples
    return SampleSequence(paths, timed) if len(timed) > 1 else None


def most_frequent(values: Iterable[float]) -> float:
    """The first of the values that occur most often after rounding to 6 digits; 0 if none."""
    found = list(values)
    rounded = [round(value, 6) for value in found]
    most = Counter(rounded).most_common(1)
    return found[rounded.index(most[0][0])] if most else 0.0
