"""The scales of a particle field, all their numbers together, beside the places of particles."""

from __future__ import annotations

from dataclasses import dataclass

from usdvol_lint.cached import cached_property
from usdvol_lint.facts.particles.array import ParticleArray
from usdvol_lint.facts.particles.arrays import ParticleArrays
from usdvol_lint.facts.particles.numbers import mean_of, spacing


@dataclass(frozen=True)
class Scales:
    """The scales that count, all of them finite, with their least and greatest number."""

    array: ParticleArray
    low: float
    high: float
    arrays: ParticleArrays

    @cached_property
    def mean(self) -> float:
        """The mean of all numbers in all samples."""
        return mean_of(self.array)

    @cached_property
    def spacing(self) -> float:
        """How far particles lie apart if they are spread evenly over the positions' bounds."""
        positions = self.arrays.positions
        return spacing(positions, self.arrays.most_particles) if positions else 0.0

    @property
    def are_spread_as_exp(self) -> bool:
        """Whether they lie above 1 as the exp of sizes does: most close to it, few far from it.

        A scan in millimetres has sizes above 1 too, but its particles lie about as far apart.
        """
        if self.low < 1 or self.mean > 1.5:
            return False
        return self.mean > 2 * self.spacing and self.high - 1 > 3 * (self.mean - 1)
