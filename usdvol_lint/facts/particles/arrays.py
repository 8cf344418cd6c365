"""The arrays of a particle field: which of each pair counts, at which times, and how they fit."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import isqrt
from typing import TYPE_CHECKING, Any, TypeAlias

from pxr import Usd, Vt

from usdvol_lint import schema
from usdvol_lint.facts.usd.steps import Time
from usdvol_lint.facts.usd.values import Value, Values, sample_times

if TYPE_CHECKING:
    from usdvol_lint.facts.particles.array import ParticleArray

Times: TypeAlias = str | int
"""Which samples of a field are looked at: `all`, `first`, `ends`, or so many, evenly spread."""

_POSITIONS, _COEFFICIENTS = "positions", "radiance:sphericalHarmonicsCoefficients"
_DEGREE = "radiance:sphericalHarmonicsDegree"
_FALLBACK_DEGREE = 3
_PAIRS: dict[str, tuple[Any, Any]] = {
    _POSITIONS: (Vt.Vec3fArray, Vt.Vec3hArray),
    "orientations": (Vt.QuatfArray, Vt.QuathArray),
    "scales": (Vt.Vec3fArray, Vt.Vec3hArray),
    "opacities": (Vt.FloatArray, Vt.HalfArray),
    _COEFFICIENTS: (Vt.Vec3fArray, Vt.Vec3hArray),
}
"""The float arrays, and the values that renderers take from them and from their half twins."""
_TYPES = {
    f"{name}{suffix}": wanted
    for name, pair in _PAIRS.items()
    for suffix, wanted in zip(("", "h"), pair, strict=True)
}


@dataclass(frozen=True, slots=True)
class Misfits(Values):
    """When an array has not as many elements as the particles take: by time both numbers."""

    noun: str

    @property
    def words(self) -> str:
        """`12 opacities for 16 particles (4 of 240 samples)`."""
        size, particles = next(iter(self))
        elements, owners = _counted(size, self.noun), _counted(particles, "particles")
        return f"{elements} for {owners}{self.count}"


@dataclass(frozen=True, slots=True)
class Degree:
    """The degree of the spherical harmonics; `value` is None where it is of another type."""

    attribute: Any
    value: int | None
    is_authored: bool

    @property
    def coefficients(self) -> int | None:
        """How many each particle has; None where the degree makes no sense."""
        return None if self.value is None or self.value < 0 else (self.value + 1) ** 2


@dataclass(frozen=True, slots=True)
class Pair:
    """The float and the half array of one kind: the one that counts, and the one that it hides.

    `arrays` are those that are authored; `is_known` is False where one is of another type.
    """

    arrays: tuple[ParticleArray, ...]
    used: ParticleArray | None
    hidden: ParticleArray | None
    is_known: bool


class ParticleArrays:
    """The arrays of one particle field that its APIs declare, and the times they are compared at.

    What is no array of the schema's type is left out.
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
        return self.pairs[_POSITIONS].used

    @property
    def coefficients(self) -> ParticleArray | None:
        return self.pairs[_COEFFICIENTS].used

    def used(self, *nouns: str) -> Iterator[ParticleArray]:
        """The arrays, of these kinds or all, that renderers get something from at some time.

        None where there are no particles: that is a finding by itself.
        """
        if self.lack_positions:
            return
        for array in (pair.used for pair in self.pairs.values()):
            if array and array.is_populated and (not nouns or array.noun in nouns):
                yield array

    def authored(self, noun: str) -> Iterator[ParticleArray]:
        """The float and the half array of one kind, whichever is there."""
        for pair in self.pairs.values():
            yield from (array for array in pair.arrays if array.noun == noun)

    def differ(self, one: ParticleArray, other: ParticleArray) -> str:
        """The first sizes that differ at one time, in words, or nothing."""
        for time in (None, *self._times):
            sizes = one.sizes.at(time), other.sizes.at(time)
            if None not in sizes and sizes[0] != sizes[1]:
                return f"{sizes[0]:,} and {sizes[1]:,}"
        return ""

    @property
    def lack_positions(self) -> bool:
        """Whether there is certainly no particle at any time."""
        return self._lack(_POSITIONS, schema.POSITIONS_API)

    @property
    def lack_coefficients(self) -> bool:
        """Whether there is certainly no coefficient at any time, though their API is applied."""
        return self._lack(_COEFFICIENTS, schema.HARMONICS_API)

    def _lack(self, name: str, api: str) -> bool:
        pair = self.pairs[name]
        is_populated = pair.used is not None and pair.used.is_populated
        return api in self._schemas and pair.is_known and not is_populated

    @property
    def most(self) -> int:
        """The greatest number of particles at any time."""
        samples = self.positions.samples if self.positions else ()
        return max((sample.size for sample in samples), default=0)

    def short(self, array: ParticleArray, each: int = 1) -> Misfits | None:
        """When an array has fewer elements than so many for each particle."""
        return self._misfits(array, each, lambda size, wanted: size < wanted)

    def long(self, array: ParticleArray, each: int = 1) -> Misfits | None:
        """When an array has more elements than so many for each particle, if there are any."""
        return self._misfits(array, each, lambda size, wanted: size > wanted > 0)

    @property
    def fitting_degree(self) -> int | None:
        """The degree that the number of coefficients speaks for at all times."""
        array = self.coefficients
        sizes = self._sizes(array) if array else ()
        shares = {divmod(size, particles) for _, size, particles in sizes if particles}
        if len(shares) != 1:
            return None
        share, rest = shares.pop()
        root = isqrt(share)
        return root - 1 if share and not rest and root * root == share else None

    def _misfits(
        self, array: ParticleArray, each: int, is_misfit: Callable[[int, int], bool]
    ) -> Misfits | None:
        found = tuple(
            Value(time, (size, particles))
            for time, size, particles in self._sizes(array)
            if is_misfit(size, particles * each)
        )
        if not found:
            return None
        return Misfits(array.attribute, found, len(self._times), array.noun)

    def _sizes(self, array: ParticleArray) -> Iterator[tuple[Time, int, int]]:
        """By time how many elements the array has, and how many particles there are."""
        for time in (None, *self._times):
            size = array.sizes.at(time)
            particles = self.positions.sizes.at(time) if self.positions else None
            if size is not None and particles is not None:
                yield time, size, particles


def read_particle_arrays(
    prim: Any,
    schemas: Collection[str],
    authored: Collection[str],
    mistyped: Collection[str],
    times: Times,
    with_counts: bool,
    advance: Callable[[int], None],
) -> ParticleArrays:
    """Reads how many elements there are at which times, and nothing of what they are.

    `schemas` are those that the prim answers to; `authored` are the attributes that one of them
    declares, `mistyped` those with another type; `with_counts` is for `ParticleArray`.
    """
    names = [name for name in _TYPES if name in authored]
    sampled = {name: sample_times(prim.GetAttribute(name)) for name in names}
    compared = chosen(sorted({time for own in sampled.values() for time in own}), times)
    arrays = {
        name: _read_array(prim.GetAttribute(name), sampled[name], compared, with_counts, advance)
        for name in names
    }
    pairs = {name: _pair(name, arrays) for name in _PAIRS}
    degree = _read_degree(prim, authored, mistyped)
    return ParticleArrays(pairs, degree, tuple(compared), schemas)


def _counted(number: int, noun: str) -> str:
    """`1 opacity`, `2 opacities`."""
    if number == 1:
        noun = f"{noun[:-3]}y" if noun.endswith("ies") else noun.removesuffix("s")
    return f"{number:,} {noun}"


def chosen(times: Sequence[float], policy: Times) -> Sequence[float]:
    """The times that are looked at, of all that there are."""
    named = {"all": len(times), "first": 1, "ends": 2}
    count = policy if isinstance(policy, int) else named[policy]
    if count >= len(times):
        return times
    if count == 1:
        return times[:1]
    last = len(times) - 1
    return [times[round(number * last / (count - 1))] for number in range(count)]


def _read_array(
    attribute: Any,
    times: Sequence[float],
    compared: Sequence[float],
    with_counts: bool,
    advance: Callable[[int], None],
) -> ParticleArray | None:
    """The array with the samples that hold at the compared times; None if it is mistyped."""
    # NumPy's import costs start-up time, and a particle field without arrays needs none.
    from usdvol_lint.facts.particles.array import ParticleArray, Sample

    own = sorted({times[max(bisect_right(times, time) - 1, 0)] for time in compared if times})
    wanted = _TYPES[attribute.GetName()]
    get = Usd.AttributeQuery(attribute).Get
    samples = []
    for time in (None, *own):
        value = attribute.Get() if time is None else get(time)
        if time is None and value is None and own:
            continue
        if value is not None and not isinstance(value, wanted):
            return None
        samples.append(Sample(time, 0 if value is None else len(value)))
    return ParticleArray(attribute, tuple(samples), len(times), with_counts, advance)


def _pair(name: str, arrays: Mapping[str, ParticleArray | None]) -> Pair:
    """As USD's imaging chooses: float, if it holds something at the earliest time, or else half."""
    authored = [arrays[each] for each in (name, f"{name}h") if each in arrays]
    known = tuple(array for array in authored if array)
    used = hidden = None
    if known:
        used, *others = known
        if others and others[0].is_populated:
            hidden = others[0]
            if not used.begins_populated:
                used, hidden = hidden, used if used.is_populated else None
    return Pair(known, used, hidden, len(known) == len(authored))


def _read_degree(prim: Any, authored: Collection[str], mistyped: Collection[str]) -> Degree:
    attribute = prim.GetAttribute(_DEGREE)
    if _DEGREE in mistyped:
        return Degree(attribute, None, True)
    if _DEGREE not in authored:
        return Degree(attribute, _FALLBACK_DEGREE, False)
    value = attribute.Get(Usd.TimeCode.EarliestTime())
    return Degree(attribute, _FALLBACK_DEGREE if value is None else value, value is not None)
