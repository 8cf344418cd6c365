"""The elements of an array that a rule asked for, by sample, and how messages name them."""

from __future__ import annotations

from dataclasses import dataclass

from usdvol_lint.facts.particles.chunks import Row
from usdvol_lint.facts.usd.values import Values


@dataclass(frozen=True, slots=True)
class Elements(Values):
    """The elements of an array that match a condition: `Matches` for each sample that has some.

    `sizes` are the sizes of these samples; `noun` is the plural that elements are called by.
    """

    sizes: tuple[int, ...]
    noun: str

    @property
    def number(self) -> int:
        """How many match, in all samples together."""
        return sum(matches.count for matches in self)

    @property
    def share(self) -> float:
        """The share of the elements of these samples that match."""
        return self.number / sum(self.sizes)

    @property
    def amount(self) -> str:
        """`3 of 1,000,000 opacities (0.0003 %)`."""
        return f"{self._amount} ({percent(self.share)})"

    def amount_that(self, one: str, several: str) -> str:
        """`1 of 500 opacities is NaN (0.2 %)`: the verb for one, and for several."""
        return f"{self._amount} {one if self.number == 1 else several} ({percent(self.share)})"

    @property
    def first(self) -> str:
        """`first 1.5 at [17] (4 of 240 samples)`, or `the one at [17]: 1.5`."""
        matches = next(iter(self))
        if self.number > 1:
            return f"first {as_text(matches.value)} at [{matches.first}]{self.count}"
        value = as_text(matches.value)
        shown = "" if value == "nan" else f": {value}"
        return f"the one at [{matches.first}]{shown}{self.count}"

    @property
    def _amount(self) -> str:
        return f"{self.number:,} of {sum(self.sizes):,} {self.noun}"


def as_text(row: Row) -> str:
    """An element as a text layer writes it."""
    if len(row) == 4:
        row = (row[3], *row[:3])  # USD stores the real part of a quaternion last
    numbers = ", ".join(f"{number:.6g}" for number in row)
    return numbers if len(row) == 1 else f"({numbers})"


def percent(share: float) -> str:
    """`33.3 %`."""
    percent = 100 * share
    return f"{percent:.3g} %" if percent >= 0.001 else "less than 0.001 %"
