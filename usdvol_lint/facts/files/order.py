"""Samples whose frame numbers break the order that all others keep."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import groupby, pairwise
from typing import NamedTuple

from usdvol_lint.facts.files.assets import Affected
from usdvol_lint.facts.files.numbering import Numbering
from usdvol_lint.facts.files.sequences import SampleSequence, most_frequent
from usdvol_lint.facts.files.states import ON_DISK

_FEWEST = 5
"""Fewer samples than this set no order that another could break."""
_SLACK = 0.01
"""How far, in frames, a number may lie from the expected one."""


class OutOfOrder(NamedTuple):
    """Samples whose frame numbers break the order that all others keep.

    `likely` is the path that the first of them would have in that order, if there is one.
    """

    affected: Affected
    likely: str | None


def find_out_of_order(sequence: SampleSequence) -> OutOfOrder | None:
    """The few samples that break the order of all others, or None if there are none.

    Files that are repeated, skipped or played at another pace keep the order, and so do loops and
    what is added at either end.  Where the expected file does not exist, another may have replaced
    it on purpose.
    """
    numbering = sequence.numbering
    if len(sequence.samples) < _FEWEST or not numbering:
        return None
    numbers = numbering.numbers
    indices = [index for index, number in enumerate(numbers) if not math.isnan(number)]
    order = _find_order(
        [sequence.times[index] for index in indices], [numbers[index] for index in indices]
    )
    if order is None:
        return None
    misplaced = {
        indices[position]: order.expected[position]
        for run in order.runs_outside()
        if order.is_broken_by(run)
        for position in run
    }
    misplaced = {
        index: number
        for index, number in misplaced.items()
        if _may_exist(sequence, numbering, index, number)
    }
    affected = sequence.paths.affected(map(sequence.samples.__getitem__, misplaced))
    if affected is None:
        return None
    number = next(iter(misplaced.values()))
    return OutOfOrder(affected, numbering.renumbered(affected.first.path, number))


class _Order(NamedTuple):
    """The frame numbers of samples, and those that are expected from the times.

    `pace` is the number of frames in one unit of time.
    """

    numbers: Sequence[float]
    expected: Sequence[float]
    pace: float

    @property
    def outside(self) -> list[bool]:
        """Whether each number differs from the expected one."""
        pairs = zip(self.numbers, self.expected, strict=True)
        return [abs(number - expected) > _SLACK for number, expected in pairs]

    def runs_outside(self) -> Iterator[list[int]]:
        """The positions of each run of samples whose numbers differ from the expected ones."""
        outside = self.outside
        for is_outside, positions in groupby(range(len(outside)), outside.__getitem__):
            if is_outside:
                yield list(positions)

    def is_broken_by(self, run: list[int]) -> bool:
        """Whether the numbers of a run go back against those before and after it.

        At either end of the sequence, whether they are the expected numbers in another order.
        """
        first, last = run[0], run[-1]
        if first == 0 or last == len(self.numbers) - 1:
            return sorted(self.numbers[first : last + 1]) == sorted(self.expected[first : last + 1])
        around = self.numbers[first - 1 : last + 2]
        return any((b - a) * self.pace < 0 for a, b in pairwise(around))


def _find_order(times: Sequence[float], numbers: Sequence[float]) -> _Order | None:
    """The order that most samples keep, or None if no sample or too many break it."""
    if len({number - time for time, number in zip(times, numbers, strict=True)}) == 1:
        return None  # all samples keep one order, as nearly always
    pace = most_frequent(
        (number - previous) / (time - before)
        for (before, time), (previous, number) in zip(
            pairwise(times), pairwise(numbers), strict=True
        )
    )
    offset = most_frequent(
        number - pace * time for time, number in zip(times, numbers, strict=True)
    )
    order = _Order(numbers, [offset + pace * time for time in times], pace)
    count = sum(order.outside)
    is_kept = len(numbers) - count >= _FEWEST and 0 < count <= max(2, len(numbers) // 10)
    return order if pace and is_kept else None


def _may_exist(sequence: SampleSequence, numbering: Numbering, index: int, number: float) -> bool:
    """Whether there may be a file with the number that is expected of a sample."""
    sample = sequence.samples[index]
    path = numbering.renumbered(sample.path, number)
    return sample.state not in ON_DISK or not path or sequence.exists(sample, path)
