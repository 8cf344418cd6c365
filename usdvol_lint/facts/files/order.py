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
"""Fewer samples make no rule that another could break."""
_SLACK = 0.01


class OutOfOrder(NamedTuple):
    """Samples whose frame numbers are out of the order that all others keep.

    `likely` is the path that the first of them would have in that order.
    """

    affected: Affected
    likely: str | None


def find_out_of_order(sequence: SampleSequence) -> OutOfOrder | None:
    """The few samples that break the order of all others, or None if there are none.

    Files that are held, skipped or played at another pace keep the order, and so do loops and
    what stands at either end.  A number whose file is not there may have been replaced on purpose.
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
    """The frame numbers of samples, and those that they would have if all followed the time.

    `pace` is how far the numbers go in one unit of time.
    """

    numbers: Sequence[float]
    expected: Sequence[float]
    pace: float

    @property
    def outside(self) -> list[bool]:
        """Whether each number is another than expected."""
        pairs = zip(self.numbers, self.expected, strict=True)
        return [abs(number - expected) > _SLACK for number, expected in pairs]

    def runs_outside(self) -> Iterator[list[int]]:
        """The positions of neighbouring samples whose numbers are not as expected."""
        outside = self.outside
        for is_outside, positions in groupby(range(len(outside)), outside.__getitem__):
            if is_outside:
                yield list(positions)

    def is_broken_by(self, run: list[int]) -> bool:
        """Whether the numbers at these positions are out of order with those around them."""
        first, last = run[0], run[-1]
        if first == 0 or last == len(self.numbers) - 1:
            return sorted(self.numbers[first : last + 1]) == sorted(self.expected[first : last + 1])
        around = self.numbers[first - 1 : last + 2]
        return any((b - a) * self.pace < 0 for a, b in pairwise(around))


def _find_order(times: Sequence[float], numbers: Sequence[float]) -> _Order | None:
    """The order that most samples keep, or None where none or too many break it."""
    if len({number - time for time, number in zip(times, numbers, strict=True)}) == 1:
        return None  # all keep it, as nearly always
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
    """Whether the file with the number that a sample should have is there, as far as is known."""
    sample = sequence.samples[index]
    path = numbering.renumbered(sample.path, number)
    return sample.state not in ON_DISK or not path or sequence.exists(sample, path)
