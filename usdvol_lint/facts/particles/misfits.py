"""Arrays that hold elements of more or fewer particles than there are, those alike together."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

from usdvol_lint.facts.particles.arrays import Misfits, ParticleArrays, counted

if TYPE_CHECKING:
    from usdvol_lint.facts.particles.array import ParticleArray


class MisfitArrays(NamedTuple):
    """Arrays that are too long, or too short, by the same number of particles at the same times.

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
        owners = counted(size // self.each, "particles")
        return f"{self.nouns} of {owners}, and there are {particles:,}{self.misfits.count}"

    @property
    def join_coefficients(self) -> bool:
        """Whether coefficients are among several arrays."""
        return len(self.arrays) > 1 and any(array.noun == "coefficients" for array in self.arrays)

    def at(self, array: ParticleArray) -> Misfits:
        """The misfits, at another array."""
        return replace(self.misfits, attribute=array.attribute)


def misfit_arrays(arrays: ParticleArrays, are_long: bool) -> tuple[MisfitArrays, ...]:
    """All arrays that are too long, or too short, coefficients only by whole particles."""
    groups: dict[tuple[object, ...], list[tuple[ParticleArray, Misfits, int]]] = {}
    others = [array for array in arrays.used() if array is not arrays.positions]
    for array, misfits, each in _misfits(arrays, are_long):
        key = tuple((sample.time, sample.value[0] // each) for sample in misfits.samples)
        groups.setdefault(key, []).append((array, misfits, each))
    return tuple(
        MisfitArrays(
            tuple(array for array, _, _ in group),
            group[0][1],
            group[0][2],
            len(others) == len(group) > 1,
        )
        for group in groups.values()
    )


def _misfits(
    arrays: ParticleArrays, are_long: bool
) -> Iterator[tuple[ParticleArray, Misfits, int]]:
    for array in arrays.used("orientations", "scales", "opacities", "coefficients"):
        each = arrays.each(array)
        found = arrays.too_long(array, each) if are_long else arrays.too_short(array, each)
        if found and not any(size % each for size, _ in found):
            yield array, found, each
