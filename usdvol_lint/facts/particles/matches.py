"""Rows of an array that have something in common: how many, and which is the first."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from usdvol_lint.facts.particles.bits import bits
from usdvol_lint.facts.particles.chunks import Row, Rows, fold

Mask: TypeAlias = Callable[[Rows, int], Rows]
"""Which rows of a chunk are meant, as one boolean each; also told where the chunk begins."""


@dataclass(frozen=True, slots=True)
class Matches:
    """Rows of one kind in an array: how many, and the first one with its place."""

    count: int
    first: int
    value: Row


def find_matches(rows: Rows, mask: Mask) -> Matches | None:
    """The rows that a mask picks, in one pass."""

    def measure(chunk: Rows, start: int) -> Matches | None:
        return matches_in(chunk, start, mask(chunk, start))

    return fold(rows, measure, join_matches)


def repetitions(rows: Rows) -> Matches | None:
    """The rows that are the same as the next one, bit by bit, in one pass."""
    values, following = bits(rows[:-1]), bits(rows[1:])

    def mask(chunk: Rows, start: int) -> Rows:
        return _equal(chunk, following[start : start + len(chunk)])

    found = find_matches(values, mask)
    return found and Matches(found.count, found.first, tuple(rows[found.first].tolist()))


def outside(chunk: Rows, low: float | Row, high: float | Row) -> Rows:
    """Which rows of a chunk have a finite number outside of the limits, of all or each column."""
    picked: Rows = ((chunk < low) | (chunk > high)) & np.isfinite(chunk)
    rows: Rows = np.logical_or.reduce(picked, axis=1)
    return rows


def is_finite(chunk: Rows) -> Rows:
    """Which rows of a chunk have neither NaN nor infinity in them."""
    rows: Rows = np.logical_and.reduce(np.isfinite(chunk), axis=1)
    return rows


def squared_norms(chunk: Rows) -> Rows:
    """The squared lengths of rows of four numbers; adding columns is quicker than adding rows."""
    wider = chunk.astype(np.float32) if chunk.dtype == np.float16 else chunk
    squares = np.square(wider).reshape(-1, 2)
    sums: Rows = (squares[:, 0] + squares[:, 1]).reshape(-1, 2)
    return sums[:, 0] + sums[:, 1]


def matches_in(chunk: Rows, start: int, picked: Rows) -> Matches | None:
    count = int(np.count_nonzero(picked))
    if not count:
        return None
    first = int(picked.argmax())
    return Matches(count, start + first, tuple(chunk[first].tolist()))


def join_matches(one: Matches | None, other: Matches | None) -> Matches | None:
    if one is None or other is None:
        return one or other
    return Matches(one.count + other.count, one.first, one.value)


def _equal(chunk: Rows, other: Rows) -> Rows:
    """Which rows are equal; other columns than the first are asked only where it says so."""
    equal: Rows = chunk[:, 0] == other[:, 0]
    for column in range(1, chunk.shape[1]):
        if not equal.any():
            break
        equal &= chunk[:, column] == other[:, column]
    return equal
