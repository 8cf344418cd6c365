"""Time samples as a sequence: their step, the numbers of their files, and what breaks the run."""

from __future__ import annotations

import math
import os
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from functools import cached_property
from itertools import groupby, islice, pairwise
from operator import attrgetter, sub
from typing import NamedTuple

from pxr import Ar

from usdvol_lint.facts.files.assets import Affected, AssetSamples, Sample
from usdvol_lint.facts.files.states import AssetState
from usdvol_lint.facts.usd.opinions import is_from_clips, strongest_opinion
from usdvol_lint.model import format_time, quoted

_DIGITS = re.compile(r"([0-9]+)")
_NUMBERS = (re.compile(r"-?[0-9]+"), re.compile(r"-?[0-9]+\.[0-9]+"))  # the latter: sub-frames
_NO_NUMBER = math.nan
_FEWEST = 5
"""Fewer samples make no rule that another could break."""
_ON_DISK = frozenset({AssetState.FILE, AssetState.NOT_A_FILE, AssetState.MISSING})
_NO_PATH = frozenset({AssetState.BROKEN_EXPRESSION, AssetState.UNSET_VARIABLE})
_SLACK = 0.01
_SHOWN = 4


class Numbering(NamedTuple):
    """The number in each path, NaN where there is none, and which of its digit groups hold it."""

    numbers: list[float]
    groups: tuple[int, ...]


class Gap(NamedTuple):
    """Times between two samples where a regular run has none, with the numbers they would have."""

    before: Sample
    times: tuple[float, ...]
    numbers: tuple[float, ...]


class Missing(NamedTuple):
    """All samples that a run lacks.

    `before` is the sample before the first of them.  `paths` are what they would name, in the
    words of those around them, and `found` those of the files that are there, by the time in the
    layer that holds the run; `found` is None where that can't be told.
    """

    before: Sample
    times: tuple[float, ...]
    paths: tuple[str, ...]
    found: tuple[tuple[float, str], ...] | None

    @property
    def advice(self) -> str:
        """What to do, with the first of the samples that are to add, as a layer has them."""
        if self.found is None:
            return "add the samples, or write the frames that are missing"
        if not self.found:
            absent = quoted(self.paths[0])
            return f"there is no file {absent} either: write the frames that are missing"
        samples = ", ".join(f"{format_time(time)}: @{path}@" for time, path in self.found[:_SHOWN])
        more = ", …" if len(self.found) > _SHOWN else ""
        there = f"{len(self.found)} of {len(self.times)} files are there"
        return f"add {samples}{more} ({'the file is there' if len(self.times) == 1 else there})"


class Strays(NamedTuple):
    """Samples whose file numbers are out of the order that all others keep.

    `meant` is the path that the first of them would have in that order.
    """

    affected: Affected
    meant: str | None


class SampleSequence:
    """The time samples of an asset attribute, of which there are two at least, in ascending time.

    Everything is found when first asked for: most sequences are regular, which is quickly seen.
    """

    def __init__(self, paths: AssetSamples, samples: Sequence[Sample]) -> None:
        self._paths = paths
        self.samples = samples
        self.times: list[float] = list(map(attrgetter("time"), samples))
        self._folders: dict[tuple[float | None, str], str] = {}

    @property
    def is_animated(self) -> bool:
        """Whether it names more than one file."""
        first = self.samples[0].path
        return any(sample.path != first for sample in self.samples)

    @cached_property
    def step(self) -> float:
        """The most frequent distance of two samples."""
        return self._steps[0] if self._is_even else _most_frequent(self._steps)

    @cached_property
    def numbering(self) -> Numbering | None:
        """The frame numbers in the paths, or None if no number varies."""
        if self._paths.states.isdisjoint(_NO_PATH):
            return number(list(map(attrgetter("path"), self.samples)))
        return number(["" if s.state in _NO_PATH else s.path for s in self.samples])

    def gaps(self) -> tuple[Gap, ...]:
        """Where samples are missing in an otherwise regular run.

        The numbers of the files must leave out what the times leave out: where they go on as if
        nothing was missing, a file is held on purpose.  So is the first sample if it stands
        alone, such as a rest frame.
        """
        if self._is_even:
            return ()
        count = len(self.samples)
        irregular = [index for index, step in enumerate(self._steps) if step != self.step]
        if len(irregular) * 5 > count or not self.numbering:
            return ()
        numbers = self.numbering.numbers
        jumps = list(map(sub, numbers[1:], numbers))
        regular = (jump for jump, step in zip(jumps, self._steps, strict=True) if step == self.step)
        pace = _most_frequent(jump for jump in regular if not math.isnan(jump))
        found = []
        for index in self._lone(irregular):
            steps = round(self._steps[index] / self.step)
            left_out = _near(self._steps[index], steps * self.step)
            if steps > 1 and pace and left_out and _near(jumps[index], steps * pace):
                found.append((index, steps))
        if sum(steps - 1 for _, steps in found) > count:
            return ()  # two ranges, and not one with something missing
        return tuple(self._gap(index, steps, pace) for index, steps in found)

    def missing(self) -> Missing | None:
        """The samples of all gaps, with those of their files that are there."""
        gaps = self.gaps()
        if not gaps:
            return None
        times: list[float] = []
        paths: list[str] = []
        found: list[tuple[float, str]] = []
        can_tell = True
        for gap in gaps:
            times += gap.times
            named = [self._renumbered(gap.before.path, number) for number in gap.numbers]
            layer_times = self._layer_times(gap)
            can_tell &= layer_times is not None and None not in named
            for time, path in zip(layer_times or (), named, strict=False):
                if path:
                    paths.append(path)
                    if self._exists(gap.before, path):
                        found.append((time, path))
        return Missing(
            gaps[0].before, tuple(times), tuple(paths), tuple(found) if can_tell else None
        )

    def strays(self) -> Strays | None:
        """The few samples that break the order of all others, or None if there are none.

        Files that are held, skipped or played at another pace keep the order, and so do loops and
        what stands at either end.  A number whose file is not there may have been replaced on
        purpose.
        """
        if len(self.samples) < _FEWEST or not self.numbering:
            return None
        numbers = self.numbering.numbers
        known = [index for index, number in enumerate(numbers) if not math.isnan(number)]
        if len({numbers[index] - self.times[index] for index in known}) == 1:
            return None
        pace = _most_frequent(
            (numbers[b] - numbers[a]) / (self.times[b] - self.times[a]) for a, b in pairwise(known)
        )
        offset = _most_frequent(numbers[index] - pace * self.times[index] for index in known)
        expected = {index: offset + pace * self.times[index] for index in known}
        outside = [abs(numbers[index] - expected[index]) > _SLACK for index in known]
        count = sum(outside)
        fits = len(known) - count >= _FEWEST and 0 < count <= max(2, len(known) // 10)
        if not pace or not fits:
            return None
        strays: list[int] = []
        for is_outside, members in groupby(range(len(known)), outside.__getitem__):
            run = list(members)
            if is_outside and self._is_disordered(run, known, expected, pace):
                strays += [known[place] for place in run]
        strays = [index for index in strays if self._may_be_there(index, expected[index])]
        affected = self._paths.affected(self.samples[index] for index in strays)
        if affected is None:
            return None
        meant = self._renumbered(affected.first.path, expected[strays[0]])
        return Strays(affected, meant)

    @cached_property
    def _steps(self) -> list[float]:
        steps = list(map(sub, self.times[1:], self.times))
        return steps if len(set(steps)) == 1 else [round(step, 6) for step in steps]

    @cached_property
    def _is_even(self) -> bool:
        return len(set(self._steps)) == 1

    def _lone(self, irregular: Iterable[int]) -> Iterator[int]:
        """The steps with regular ones around them, or one more like them: a retime has many."""
        for _, members in groupby(enumerate(irregular), lambda item: item[1] - item[0]):
            run = [index for _, index in members]
            if len(run) <= 2 and run[0] > 0:
                yield from run

    def _gap(self, index: int, steps: int, pace: float) -> Gap:
        assert self.numbering
        start, first = self.times[index], self.numbering.numbers[index]
        step = (self.times[index + 1] - start) / steps
        return Gap(
            self.samples[index],
            tuple(start + number * step for number in range(1, steps)),
            tuple(first + number * pace for number in range(1, steps)),
        )

    def _layer_times(self, gap: Gap) -> list[float] | None:
        """The times of a gap in the layer that holds it, or None if they mean nothing there."""
        attribute, time = self._paths.attribute, gap.before.time
        held = strongest_opinion(attribute, time)
        if held is None or gap.before.state not in _ON_DISK or is_from_clips(attribute, time):
            return None
        inverse = held.offset.GetInverse()
        return [inverse * missing for missing in gap.times]

    def _exists(self, sample: Sample, path: str) -> bool:
        """Whether a file is where `path` would lead in place of the sample's own."""
        head, _, name = path.partition(":SDF_FORMAT_ARGS:")[0].rpartition("/")
        key = (sample.time, head)
        if key not in self._folders:
            anchored = self._paths.anchored(sample._replace(path=path))
            if Ar.IsPackageRelativePath(anchored):
                return bool(Ar.GetResolver().Resolve(anchored))
            self._folders[key] = os.path.dirname(anchored)
        return os.path.isfile(f"{self._folders[key]}/{name}")

    def _renumbered(self, path: str, number: float) -> str | None:
        """A path of the sequence with another number in it, as wide as its own."""
        assert self.numbering
        number = round(number, 3)
        if number < 0 or not number.is_integer():
            return None
        parts = _DIGITS.split(path)
        for group in self.numbering.groups:
            width = len(parts[2 * group + 1])
            parts[2 * group + 1] = f"{int(number):0{width}}"
        return "".join(parts)

    def _is_disordered(
        self, run: list[int], known: list[int], expected: dict[int, float], pace: float
    ) -> bool:
        """Whether samples, by their places in `known`, break the order of those around them."""
        assert self.numbering
        numbers = self.numbering.numbers
        here = [numbers[known[place]] for place in run]
        if run[0] == 0 or run[-1] == len(known) - 1:
            return sorted(here) == sorted(expected[known[place]] for place in run)
        around = [numbers[known[run[0] - 1]], *here, numbers[known[run[-1] + 1]]]
        return any((b - a) * pace < 0 for a, b in pairwise(around))

    def _may_be_there(self, index: int, number: float) -> bool:
        sample = self.samples[index]
        meant = self._renumbered(sample.path, number)
        return sample.state not in _ON_DISK or not meant or self._exists(sample, meant)


def read_sequence(paths: AssetSamples) -> SampleSequence | None:
    """The time samples as a sequence, or None if there are less than two."""
    samples = paths.samples
    timed = samples[1:] if samples and samples[0].time is None else samples
    return SampleSequence(paths, timed) if len(timed) > 1 else None


def number(paths: Sequence[str]) -> Numbering | None:
    """The last number that varies in the paths; most of them must be alike but for numbers."""
    return _number_that_alone_differs(paths) or _number_of_most(paths)


def _number_that_alone_differs(paths: Sequence[str]) -> Numbering | None:
    """Quick, and enough for a sequence whose paths differ in one number and nothing else."""
    low, high = min(paths), max(paths)
    pairs = enumerate(zip(low, high, strict=False))
    same = next((index for index, (a, b) in pairs if a != b), len(low))
    before = len(low[:same].rstrip("0123456789"))
    for pattern in _NUMBERS:
        found = pattern.match(low, before)
        if found is None or low == high:
            break
        after = len(low) - found.end()
        numbers = [path[before : len(path) - after] for path in paths]
        ends = {path[-after:] for path in paths} if after else {""}
        if len(ends) == 1 and _are_numbers(numbers):
            group = len(_DIGITS.findall(low, 0, before))
            return Numbering(list(map(float, numbers)), (group,))
    return None


def _are_numbers(texts: Sequence[str]) -> bool:
    joined = "".join(texts)
    if joined.isascii() and joined.isdecimal() and all(texts):  # nearly always, and at once
        return True
    return all(any(pattern.fullmatch(text) for pattern in _NUMBERS) for text in texts)


def _number_of_most(paths: Sequence[str]) -> Numbering | None:
    """What two neighbours in the middle differ in, where most other paths are like them."""
    neighbours = pairwise(islice(paths, len(paths) // 2 - 1, None))
    one, other = next((pair for pair in neighbours if pair[0] != pair[1]), ("", ""))
    parts, others = _DIGITS.split(one), _DIGITS.split(other)
    places = [
        place for place, pair in enumerate(zip(parts, others, strict=False)) if len({*pair}) > 1
    ]
    if len(parts) != len(others) or not places or not all(place % 2 for place in places):
        return None
    last = places[-1]
    shape = [re.escape(part) for part in parts]
    for place in places:
        shape[place] = "([0-9]+)" if place == last else "[0-9]+"
    found = list(map(re.compile("".join(shape)).fullmatch, paths))
    if found.count(None) * 5 > len(paths):
        return None
    numbers = [float(match[1]) if match else _NO_NUMBER for match in found]
    same = [place // 2 for place in places if parts[place] == parts[last]]
    return Numbering(numbers, tuple(same))


def _most_frequent(values: Iterable[float]) -> float:
    """The first of those that occur most often, but for rounding; 0 if there are none."""
    found = list(values)
    rounded = [round(value, 6) for value in found]
    most = Counter(rounded).most_common(1)
    return found[rounded.index(most[0][0])] if most else 0.0


def _near(one: float, other: float) -> bool:
    return math.isclose(one, other, rel_tol=1e-6, abs_tol=1e-4)
