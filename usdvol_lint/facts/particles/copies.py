"""Particles that equal the next one in every array, at all times."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from usdvol_lint.facts.particles import matches
from usdvol_lint.facts.particles.array import ParticleArray
from usdvol_lint.facts.particles.arrays import ParticleArrays
from usdvol_lint.facts.particles.chunks import Rows
from usdvol_lint.facts.particles.elements import percent
from usdvol_lint.facts.usd.values import read_values


@dataclass(frozen=True, slots=True)
class Copies:
    """Particles like the next one; `attribute` is that of the positions.

    `first` is the index of the first one, `are_half` whether positions are of half precision.
    """

    attribute: Any
    count: int
    total: int
    first: int
    are_half: bool

    @property
    def share(self) -> float:
        return self.count / self.total

    @property
    def words(self) -> str:
        """`2 of 9 particles (22.2 %) are like the next in every array, first at [3]`."""
        amount = f"{self.count:,} of {self.total:,} particles ({percent(self.share)})"
        verb, first = ("is", "the one") if self.count == 1 else ("are", "first")
        return f"{amount} {verb} like the next in every array, {first} at [{self.first}]"


def copied_particles(prim: Any, arrays: ParticleArrays, unseen: Rows | None) -> Copies | None:
    """The particles that equal the next one bit by bit, without `unseen` ones.

    A boolean is kept for each particle, and an array is read only while some still are alike.
    """
    positions = next(arrays.used("positions"), None)
    if not positions or positions.most < 2 or not _are_known(arrays):
        return None
    alike: Rows = np.ones(positions.most - 1, np.bool_)
    if unseen is not None:
        alike &= ~unseen[:-1]
    for _, rows in positions.read(lambda sample: sample.size > 1 and bool(alike.any())):
        matches.keep_repeated(alike, rows)
    for rows in _others(prim, arrays):
        if not alike.any():
            return None
        matches.keep_alike(alike, rows)
    count = int(np.count_nonzero(alike))
    if not count:
        return None
    first = int(alike.argmax())
    return Copies(positions.attribute, count, positions.most, first, positions.is_half)


def _are_known(arrays: ParticleArrays) -> bool:
    """Whether all values that tell particles apart can be read."""
    if any(arrays.used("coefficients")) and not arrays.degree.coefficients:
        return False
    return all(pair.is_known for pair in arrays.pairs.values()) and all(
        array.is_read_whole for array in arrays.used()
    )


def _others(prim: Any, arrays: ParticleArrays) -> Iterator[Rows]:
    """A row for each particle, from every sample of every array but the positions."""
    for array in arrays.used("scales", "opacities", "orientations", "coefficients"):
        each = arrays.each(array)
        if not arrays.too_short(array, each):  # else USD ignores it
            yield from _by_particle(array, each)
    yield from _foreign(prim, arrays)


def _by_particle(array: ParticleArray, each: int) -> Iterator[Rows]:
    for _, rows in array.read():
        count = len(rows) // each
        if count > 1:
            yield rows[: count * each].reshape(count, -1)


def _foreign(prim: Any, arrays: ParticleArrays) -> Iterator[Rows]:
    """The same of other attributes with as many elements as there are particles, or a multiple."""
    count = arrays.most_particles
    ours = {"extent", *(array.name for pair in arrays.pairs.values() for array in pair.arrays)}
    for attribute in prim.GetAuthoredAttributes():
        if attribute.GetName() in ours or not attribute.GetTypeName().isArray:
            continue
        for _, value in read_values(attribute):
            # A layer may give what is declared as an array a value that is none.
            size = len(value) if type(value).__name__.endswith("Array") else 0
            if size and size % count == 0:
                yield np.asarray(value).reshape(count, -1)
