"""Arrays that hold the elements of more particles than there are, those that are alike together."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from usdvol_lint.facts.particles.array import ParticleArray
from usdvol_lint.facts.particles.arrays import Misfits, ParticleArrays


class Surplus(NamedTuple):
    """Arrays that are too long by the same number of particles at the same times.

    `misfits` are those of the first of them; `are_all` says that no other array is read.
    """

    arrays: tuple[ParticleArray, ...]
    misfits: Misfits
    each: int
    are_all: bool

    @property
    def nouns(self) -> str:
        """`orientations, scales and opacities`."""
        *others, last = (array.noun for array in self.arrays)
        return f"{', '.join(others)} and {last}" if others else last

    @property
    def words(self) -> str:
        """`scales and opacities of 12 particles, and there are 10 (4 of 240 samples)`."""
        size, particles = next(iter(self.misfits))
        count = self.misfits.count
        return (
            f"{self.nouns} of {size // self.each:,} particles, and there are {particles:,}{count}"
        )


def surpluses(arrays: ParticleArrays) -> tuple[Surplus, ...]:
    """All arrays that are too long, coefficients only by whole particles."""
    groups: dict[tuple[object, ...], list[tuple[ParticleArray, Misfits, int]]] = {}
    others = [array for array in arrays.used() if array is not arrays.positions]
    for array, long, each in _too_long(arrays):
        key = tuple((sample.time, sample.value[0] // each) for sample in long.samples)
        groups.setdefault(key, []).append((array, long, each))
    return tuple(
        Surplus(
            tuple(array for array, _, _ in group),
            group[0][1],
            group[0][2],
            len(others) == len(group) > 1,
        )
        for group in groups.values()
    )


def _too_long(arrays: ParticleArrays) -> Iterator[tuple[ParticleArray, Misfits, int]]:
    for array in arrays.used("orientations", "scales", "opacities", "coefficients"):
        each = arrays.each(array)
        long = arrays.too_long(array, each)
        if long and not any(size % each for size, _ in long):
            yield array, long, each
