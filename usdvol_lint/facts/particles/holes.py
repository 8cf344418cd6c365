"""Holes in time: blocked samples between others that have elements."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from itertools import groupby
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from usdvol_lint.facts.particles.array import ParticleArray

_LONGEST_SLIP = 3
"""A hole of more frames than these is hardly a slip."""


class Hole(NamedTuple):
    """The times, one after the other, at which arrays hold nothing."""

    arrays: tuple[ParticleArray, ...]
    times: tuple[float, ...]

    @property
    def words(self) -> str:
        """The names of the arrays, and a verb."""
        *others, last = (repr(array.name) for array in self.arrays)
        return f"{', '.join(others)} and {last} hold" if others else f"{last} holds"


def find_holes(arrays: Iterable[ParticleArray], positions: ParticleArray | None) -> list[Hole]:
    """The only short hole of each array, those of several arrays at the same times together.

    Where there are no particles, nothing else matters.
    """
    found: dict[tuple[float, ...], list[ParticleArray]] = defaultdict(list)
    for array in arrays:
        times = _only_hole(array)
        if array is not positions and positions:
            times = tuple(time for time in times if positions.sizes.at(time))
        if times:
            found[times].append(array)
    return [Hole(tuple(members), times) for times, members in found.items()]


def _only_hole(array: ParticleArray) -> tuple[float, ...]:
    """The times of the only hole, if there is one, and it is short.

    What is blocked before the first elements and after the last is none, nor is what is empty.
    """
    timed = [sample for sample in array.samples if sample.time is not None]
    runs = [
        (is_filled, list(members))
        for is_filled, members in groupby(timed, lambda sample: sample.size > 0)
    ]
    holes = [number for number in range(1, len(runs) - 1) if not runs[number][0]]
    if len(holes) != 1 or not all(sample.is_blocked for sample in runs[holes[0]][1]):
        return ()
    before, times, after = (
        tuple([sample.time or 0.0 for sample in members])
        for _, members in runs[holes[0] - 1 : holes[0] + 2]
    )
    is_short = after[0] - times[0] <= _LONGEST_SLIP * (times[0] - before[-1]) + 1e-6
    return times if is_short else ()
