"""Elements of an array that have something in common, in each sample, and in words."""

from __future__ import annotations

from dataclasses import dataclass

from usdvol_lint.facts.particles.chunks import Row
from usdvol_lint.facts.usd.values import Values


@dataclass(frozen=True, slots=True)
class Elements(Values):
    """Elements of an array that have something in common: those in each sample.

    `sizes` are the samples', `noun` their elements'.
    """

    sizes: tuple[int, ...]
    noun: str

    @property
    def share(self) -> float:
        """How much of the samples it is in."""
        return self._count / sum(self.sizes)

    @property
    def amount(self) -> str:
        """`3 of 1,000,000 opacities (0.0003 %)`."""
        return f"{self._count:,} of {sum(self.sizes):,} {self.noun} ({_percent(self.share)})"

    @property
    def first(self) -> str:
        """`first 1.5 at [17] (4 of 240 samples)`."""
        found = next(iter(self))
        return f"first {written(found.value)} at [{found.first}]{self.count}"

    @property
    def _count(self) -> int:
        return sum(found.count for found in self)


def written(row: Row) -> str:
    """An element as a text layer has it."""
    if len(row) == 4:
        row = (row[3], *row[:3])  # in memory the real part of a quaternion comes last
    numbers = ", ".join(f"{number:.6g}" for number in row)
    return numbers if len(row) == 1 else f"({numbers})"


def _percent(share: float) -> str:
    percent = 100 * share
    return f"{percent:.3g} %" if percent >= 0.001 else "less than 0.001 %"
