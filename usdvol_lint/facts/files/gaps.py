"""Samples that are missing in an otherwise regular sequence."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from itertools import groupby
from operator import sub
from typing import NamedTuple

from usdvol_lint.facts.files.assets import AssetSample
from usdvol_lint.facts.files.numbering import Numbering
from usdvol_lint.facts.files.sequences import SampleSequence, most_frequent
from usdvol_lint.facts.files.states import ON_DISK
from usdvol_lint.facts.usd.opinions import is_from_clips, strongest_opinion
from usdvol_lint.words import format_time, quoted

_SHOWN = 4


class Missing(NamedTuple):
    """The samples that a sequence lacks.

    `before` is the sample before the first of them; `present` is how many samples there are.
    `times` are stage times; `paths` are the paths that the missing samples would have.
    `found` are the layer times and paths of those whose files exist, None if that is unknown.
    """

    before: AssetSample
    present: int
    times: tuple[float, ...]
    paths: tuple[str, ...]
    found: tuple[tuple[float, str], ...] | None

    @property
    def advice(self) -> str:
        """What to do, with the first of the samples to add as they are written in a layer."""
        if self.found is None:
            return "add the samples, or write the frames that are missing"
        if not self.found:
            absent = quoted(self.paths[0])
            return f"there is no file {absent} either: write the frames that are missing"
        samples = ", ".join(f"{format_time(time)}: @{path}@" for time, path in self.found[:_SHOWN])
        more = ", …" if len(self.found) > _SHOWN else ""
        there = f"{len(self.found)} of {len(self.times)} files are there"
        return f"add {samples}{more} ({'the file is there' if len(self.times) == 1 else there})"


class Gap(NamedTuple):
    """A hole after one sample: the missing stage times, and the frame numbers at these."""

    before: AssetSample
    times: tuple[float, ...]
    numbers: tuple[float, ...]


def find_missing(sequence: SampleSequence) -> Missing | None:
    """The missing samples of all gaps; None if there are none."""
    if sequence.is_even:
        return None
    numbering = sequence.numbering
    gaps = _gaps(sequence, numbering) if numbering else []
    if not numbering or not gaps:
        return None
    times: list[float] = []
    paths: list[str] = []
    found: list[tuple[float, str]] = []
    is_known = True
    for gap in gaps:
        times += gap.times
        named = [numbering.renumbered(gap.before.path, number) for number in gap.numbers]
        layer_times = _layer_times(sequence, gap)
        is_known &= layer_times is not None and None not in named
        for time, path in zip(layer_times or (), named, strict=False):
            if path:
                paths.append(path)
                if sequence.exists(gap.before, path):
                    found.append((time, path))
    files = tuple(found) if is_known else None
    return Missing(gaps[0].before, len(sequence.samples), tuple(times), tuple(paths), files)


def _gaps(sequence: SampleSequence, numbering: Numbering) -> list[Gap]:
    """Where samples are missing in an otherwise regular sequence.

    The frame numbers must skip as much as the times: if they go on without a jump, one file is
    shown longer on purpose.  So is a lone first sample, such as a rest frame.
    """
    count, steps, usual = len(sequence.samples), sequence.steps, sequence.step
    irregular = [index for index, step in enumerate(steps) if step != usual]
    if len(irregular) * 5 > count or not _are_steps(steps):
        return []
    numbers = numbering.numbers
    jumps = list(map(sub, numbers[1:], numbers))
    regular = (jump for jump, step in zip(jumps, steps, strict=True) if step == usual)
    pace = most_frequent(jump for jump in regular if not math.isnan(jump))
    found = []
    for index in _isolated(irregular):
        length = round(steps[index] / usual)
        is_multiple = _near(steps[index], length * usual)
        if length > 1 and pace and is_multiple and _near(jumps[index], length * pace):
            found.append((index, length))
    if sum(length - 1 for _, length in found) > count:
        return []  # more is missing than present: these are separate ranges
    return [_gap(sequence, numbers[index], index, length, pace) for index, length in found]


def _are_steps(steps: Iterable[float]) -> bool:
    """Whether each step is a number of frames: none is rounded to 0, or beyond all numbers."""
    return all(step and math.isfinite(step) for step in steps)


def _isolated(irregular: Iterable[int]) -> Iterator[int]:
    """Irregular steps, alone or in pairs, but for the first step: a longer run is a retime."""
    for _, members in groupby(enumerate(irregular), lambda item: item[1] - item[0]):
        run = [index for _, index in members]
        if len(run) <= 2 and run[0] > 0:
            yield from run


def _gap(sequence: SampleSequence, first: float, index: int, length: int, pace: float) -> Gap:
    """The gap after the sample at `index`, whose frame number is `first`, `length` steps long."""
    start = sequence.times[index]
    step = (sequence.times[index + 1] - start) / length
    return Gap(
        sequence.samples[index],
        tuple(start + number * step for number in range(1, length)),
        tuple(first + number * pace for number in range(1, length)),
    )


def _layer_times(sequence: SampleSequence, gap: Gap) -> list[float] | None:
    """The times of a gap in the layer of the samples; None if a sample can't be added there."""
    attribute, time = sequence.paths.attribute, gap.before.time
    strongest = strongest_opinion(attribute, time)
    if strongest is None or gap.before.state not in ON_DISK or is_from_clips(attribute, time):
        return None
    inverse = strongest.offset.GetInverse()
    return [inverse * missing for missing in gap.times]


def _near(one: float, other: float) -> bool:
    return math.isclose(one, other, rel_tol=1e-6, abs_tol=1e-4)
