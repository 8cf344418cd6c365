"""Numbers that are not finite, in several arrays together where they are of the same particles."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, NamedTuple

from usdvol_lint.facts.particles.raw import raw_numbers

if TYPE_CHECKING:
    from usdvol_lint.facts.particles.array import ParticleArray
    from usdvol_lint.facts.particles.arrays import ParticleArrays
    from usdvol_lint.facts.particles.elements import Elements


class Spoilt(NamedTuple):
    """An array with its elements that are not finite, and the nouns of others with the same."""

    array: ParticleArray
    found: Elements
    others: list[str]

    @property
    def shared(self) -> str:
        """`, together with scales, opacities of the same particles`, or empty."""
        owners = "particle" if self.found.number == 1 else "particles"
        return f", together with {', '.join(self.others)} of the same {owners}" * bool(self.others)


def spoilt_arrays(
    found: Iterable[tuple[ParticleArray, Elements]], arrays: ParticleArrays
) -> list[Spoilt]:
    """One for each array, or for several with as many particles at the same first place."""
    spoilt: list[Spoilt] = []
    for array, elements in found:
        alike = (
            one
            for one in spoilt
            if not (_has_a_meaning(array) or _has_a_meaning(one.array))
            and _are_of_the_same(one.found, elements, arrays.each(array))
        )
        first = next(alike, None)
        if first:
            first.others.append(array.noun)
        else:
            spoilt.append(Spoilt(array, elements, []))
    return spoilt


def _has_a_meaning(array: ParticleArray) -> bool:
    """Whether infinity may mean something: an overflow, an opaque particle, a logarithm of 0."""
    may = array.is_half or array.noun == "opacities" or raw_numbers(array) is not None
    return array.has_infinity and may


def _are_of_the_same(one: Elements, other: Elements, each: int) -> bool:
    """Whether elements are probably of the same particles; `each` of the `other` are of one."""
    if [sample.time for sample in one.samples] != [sample.time for sample in other.samples]:
        return False
    return all(
        mine.first == its.first // each and mine.count <= its.count <= mine.count * each
        for mine, its in zip(one, other, strict=True)
    )
