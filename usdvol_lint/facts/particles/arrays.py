"""The arrays of a particle field: which of each pair renderers use, and whether sizes fit."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass
from math import isqrt
from typing import TYPE_CHECKING, Any, NamedTuple

from usdvol_lint import schema
from usdvol_lint.facts.usd.steps import Time
from usdvol_lint.facts.usd.values import Value, Values

if TYPE_CHECKING:
    from usdvol_lint.facts.particles.array import ParticleArray
    from usdvol_lint.facts.particles.holes import Hole
    from usdvol_lint.facts.particles.spans import Span
    from usdvol_lint.facts.particles.spoilt import Spoilt


POSITIONS, COEFFICIENTS = "positions", "radiance:sphericalHarmonicsCoefficients"


@dataclass(frozen=True, slots=True)
class Misfits(Values):
    """The samples in which an array has too few or too many elements for the particles.

    Each value is the size of the array and the number of particles.
    """

    noun: str

    @property
    def words(self) -> str:
        """`12 opacities for 16 particles (4 of 240 samples)`."""
        size, particles = next(iter(self))
        elements, owners = counted(size, self.noun), counted(particles, "particles")
        return f"{elements} for {owners}{self.count}"

    @property
    def shares(self) -> str:
        """`2,000 coefficients, 4 for each particle`, or `words` if they can't be shared out."""
        size, particles = next(iter(self))
        if not size or size % particles:
            return self.words
        return f"{counted(size, self.noun)}, {size // particles:,} for each particle{self.count}"


class Degree(NamedTuple):
    """The degree of the spherical harmonics; `value` is None if the attribute is mistyped."""

    attribute: Any
    value: int | None
    is_authored: bool

    @property
    def coefficients(self) -> int | None:
        """How many coefficients each particle takes; None for a negative or mistyped degree."""
        return None if self.value is None or self.value < 0 else (self.value + 1) ** 2


class LateArray(NamedTuple):
    """A float array without elements at its `earliest` time; the first are at `filled`."""

    array: ParticleArray
    earliest: float
    filled: float


class Pair(NamedTuple):
    """The float and the half array of one attribute, such as `scales` and `scalesh`.

    `arrays` are the authored ones of the schema's type; `is_known` is False if one is mistyped.
    Renderers read `used`; `hidden` is an array with elements that they do not read.
    """

    arrays: tuple[ParticleArray, ...]
    used: ParticleArray | None
    hidden: ParticleArray | None
    is_known: bool

    @property
    def late(self) -> LateArray | None:
        """The float array that renderers choose and that begins empty; None if there is none.

        OpenUSD's imaging reads it only if it has elements at its earliest time.
        """
        array = self.used
        if not array or array.is_half or not array.is_populated or array.begins_populated:
            return None
        if not self.is_known:
            return None  # a half array of another type
        times = [(sample.time, sample.size) for sample in array.samples if sample.time is not None]
        filled = next((time for time, size in times if size), None)
        return None if filled is None else LateArray(array, times[0][0], filled)


class ParticleArrays:
    """The arrays of one particle field that its APIs declare, without mistyped ones.

    `times` are those at which sizes are compared, after the default; `schemas` are those that the
    prim answers to.
    """

    def __init__(
        self,
        pairs: Mapping[str, Pair],
        degree: Degree,
        times: tuple[float, ...],
        schemas: Collection[str],
    ) -> None:
        self.pairs = pairs
        self.degree = degree
        self._times = times
        self._schemas = schemas

    @property
    def positions(self) -> ParticleArray | None:
        return self.pairs[POSITIONS].used

    @property
    def coefficients(self) -> ParticleArray | None:
        return self.pairs[COEFFICIENTS].used

    def used(self, *nouns: str) -> Iterator[ParticleArray]:
        """The arrays with these nouns, or all, of which renderers read elements at some time.

        There are none without particles, which is a finding of its own.
        """
        if self.lack_positions:
            return
        for array in (pair.used for pair in self.pairs.values()):
            if array and array.is_populated and (not nouns or array.noun in nouns):
                yield array

    def finite(self, noun: str) -> ParticleArray | None:
        """The array with this noun that renderers read elements of, if all numbers are finite."""
        array = next(self.used(noun), None)
        return None if array is None or array.has_nan or array.has_infinity else array

    def non_finite(self) -> list[Spoilt]:
        """The arrays with numbers that are not finite, those of the same particles together."""
        found = ((array, array.non_finite()) for array in self.used())
        present = [(array, elements) for array, elements in found if elements]
        if not present:
            return []
        from usdvol_lint.facts.particles.spoilt import spoilt_arrays

        return spoilt_arrays(present, self)

    def holes(self) -> list[Hole]:
        """The arrays that hold nothing at a few times, and something before and after."""
        gappy = [array for array in self.used() if any(each.is_blocked for each in array.samples)]
        if not gappy:
            return []
        from usdvol_lint.facts.particles.holes import find_holes

        return find_holes(gappy, self.positions)

    def spans(self) -> list[Span]:
        """From when to when the arrays with several samples have these."""
        if not any(array.total > 1 for array in self.used()):
            return []
        from usdvol_lint.facts.particles.spans import spans_of

        return spans_of(self.used())

    @property
    def late_positions(self) -> LateArray | None:
        """Float positions that begin empty, so that OpenUSD draws no particle at any time."""
        return self.pairs[POSITIONS].late

    def late(self) -> Iterator[LateArray]:
        """The other float arrays that begin empty, and that fit the particles at all times."""
        for array in self.used():
            late = self.pairs[array.float_name].late
            if late and array is not self.positions and not self.too_short(array, self.each(array)):
                yield late

    def authored(self, noun: str) -> Iterator[ParticleArray]:
        """The float and the half array with this noun, as far as they are authored."""
        for pair in self.pairs.values():
            yield from (array for array in pair.arrays if array.noun == noun)

    def size_difference(self, one: ParticleArray, other: ParticleArray) -> str:
        """The sizes of two arrays at the first time at which they differ, in words; else empty."""
        for time in (None, *self._times):
            sizes = one.sizes.at(time), other.sizes.at(time)
            if None not in sizes and sizes[0] != sizes[1]:
                return f"{sizes[0]:,} and {sizes[1]:,}"
        return ""

    @property
    def lack_positions(self) -> bool:
        """Whether there certainly is no particle at any time."""
        return self._lack(POSITIONS, schema.POSITIONS_API)

    @property
    def are_colourless(self) -> bool:
        """Whether particles with the API of coefficients certainly have none at any time."""
        return self._lack(COEFFICIENTS, schema.HARMONICS_API) and self.most_particles > 0

    @property
    def emptied(self) -> ParticleArray | None:
        """The positions whose default has particles, and none of whose time samples has any."""
        array = self.positions
        return array if array and self.lack_positions and array.most else None

    def lack(self, name: str) -> bool:
        """Whether there certainly is no element of an array at any time, by its float name."""
        pair = self.pairs[name]
        return pair.is_known and not (pair.used is not None and pair.used.is_populated)

    def _lack(self, name: str, api: str) -> bool:
        return api in self._schemas and self.lack(name)

    @property
    def most_particles(self) -> int:
        """The greatest number of particles at any time."""
        return self.positions.most if self.positions else 0

    def too_short(self, array: ParticleArray, per_particle: int = 1) -> Misfits | None:
        """The samples with fewer than `per_particle` elements for each particle."""
        return self._misfits(array, per_particle, lambda size, wanted: size < wanted)

    def too_long(self, array: ParticleArray, per_particle: int = 1) -> Misfits | None:
        """The samples with more than `per_particle` elements for each particle, if any."""
        return self._misfits(array, per_particle, lambda size, wanted: size > wanted > 0)

    def fit(self, array: ParticleArray) -> bool:
        """Whether an array has as many elements as the particles take; of positions, all others."""
        others = [array] if array is not self.positions else self.used()
        sizes = [(other, self.each(other)) for other in others if other is not self.positions]
        return not any(self.too_short(*size) or self.too_long(*size) for size in sizes)

    def others_fit(self, array: ParticleArray) -> bool:
        """Whether there are other arrays beside the positions, and all of them fit these."""
        others = [other for other in self.used() if other not in (array, self.positions)]
        return bool(others) and all(map(self.fit, others))

    def each(self, array: ParticleArray) -> int:
        """How many elements of an array a particle takes."""
        return self.degree.coefficients or 1 if array is self.coefficients else 1

    @property
    def fitting_degree(self) -> int | None:
        """The degree that fits the number of coefficients at all times; None if none does."""
        array = self.coefficients
        sizes = self._sizes(array) if array else ()
        shares = {divmod(size, particles) for _, size, particles in sizes if particles}
        if len(shares) != 1:
            return None
        share, rest = shares.pop()
        root = isqrt(share)
        return root - 1 if share and not rest and root * root == share else None

    @property
    def absent_degree(self) -> tuple[str, ...]:
        """The name of the degree where none is authored, and one would fit."""
        is_absent = not self.degree.is_authored and self.fitting_degree is not None
        return (self.degree.attribute.GetName(),) if is_absent else ()

    @property
    def suit_degree(self) -> bool:
        """Whether there are not too few coefficients, nor those of another degree, if any."""
        each, fitting = self.degree.coefficients, self.fitting_degree
        used = self.used("coefficients") if each else ()
        return not any(
            self.too_short(array, each or 1) or fitting not in (None, self.degree.value)
            for array in used
        )

    def _misfits(
        self, array: ParticleArray, per_particle: int, is_misfit: Callable[[int, int], bool]
    ) -> Misfits | None:
        samples = tuple(
            Value(time, (size, particles))
            for time, size, particles in self._sizes(array)
            if is_misfit(size, particles * per_particle)
        )
        if not samples:
            return None
        return Misfits(array.attribute, samples, len(self._times), array.noun)

    def _sizes(self, array: ParticleArray) -> Iterator[tuple[Time, int, int]]:
        """Time, number of elements and number of particles, where both arrays have a value."""
        for time in (None, *self._times):
            size = array.sizes.at(time)
            particles = self.positions.sizes.at(time) if self.positions else None
            if size is not None and particles is not None:
                yield time, size, particles


def counted(number: int, noun: str) -> str:
    """`1 opacity`, `2 opacities`."""
    if number == 1:
        noun = f"{noun[:-3]}y" if noun.endswith("ies") else noun.removesuffix("s")
    return f"{number:,} {noun}"
