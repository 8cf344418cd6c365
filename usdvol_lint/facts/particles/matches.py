"""The rows of an array that a mask selects: how many there are, and the first of them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import reduce
from operator import and_
from typing import TypeAlias

import numpy as np

from usdvol_lint.facts.particles.bits import bits, ordered
from usdvol_lint.facts.particles.chunks import READ_ONCE, Row, Rows, fold

Mask: TypeAlias = Callable[[Rows, int], Rows]
"""Selects rows: from a chunk and the index of its first row to one boolean per row."""


@dataclass(frozen=True, slots=True)
class Matches:
    """How many rows match; the index of the first, and its value."""

    count: int
    first: int
    value: Row


def find_matches(rows: Rows, mask: Mask) -> Matches | None:
    """The rows that a mask selects, in one pass; None if there are none."""

    def measure(chunk: Rows, start: int) -> Matches | None:
        return matches_in(chunk, start, mask(chunk, start))

    return fold(rows, measure, join_matches)


def keep(left: Rows, rows: Rows, mask: Mask) -> None:
    """Takes those out of `left`, a boolean for each row, that a mask does not select."""

    def measure(chunk: Rows, start: int) -> None:
        left[start : start + len(chunk)] &= mask(chunk, start)

    fold(rows, measure, _nothing)


def keep_repeated(left: Rows, rows: Rows) -> None:
    """Takes those out of `left` that do not equal the next row bit by bit, or are not finite."""
    values, following = bits(rows[:-1]), bits(rows[1:])

    def measure(chunk: Rows, start: int) -> None:
        part = left[start : start + len(chunk)]
        part &= _equal(chunk, following[start : start + len(chunk)])
        if part.any():
            part &= is_finite(rows[start : start + len(chunk)])

    fold(values, measure, _nothing)


def keep_alike(left: Rows, rows: Rows) -> None:
    """The same where few are left: only their rows, of any type, are looked at."""
    is_ours = rows.dtype in (np.float16, np.float32)
    values = bits(rows) if is_ours else rows

    def measure(part: Rows, start: int) -> None:
        places = start + np.flatnonzero(part)
        if len(places):
            alike = (values[places] == values[places + 1]).all(axis=1)
            part[places - start, 0] = alike & is_finite(rows[places]) if is_ours else alike

    fold(left[: len(rows) - 1].reshape(-1, 1), measure, _nothing, READ_ONCE // rows.shape[1])


def _nothing(one: None, other: None) -> None:
    """Joins nothing with nothing."""


def outside(chunk: Rows, low: float | Row, high: float | Row) -> Rows:
    """Which rows have a finite number outside the limits, which are for all columns or for each."""
    beyond: Rows = ((chunk < low) | (chunk > high)) & np.isfinite(chunk)
    rows: Rows = np.logical_or.reduce(beyond, axis=1)
    return rows


def rows_outside(chunk: Rows, low: Rows, high: Rows) -> Rows:
    """The indices of rows with a number outside the limits of its column, or nearly so.

    Limits are rounded inwards to the precision of the chunk, and keys of halfs are compared.
    """
    kind = chunk.dtype.type
    lowest = np.nextafter(low.astype(kind), kind(np.inf))
    highest = np.nextafter(high.astype(kind), kind(-np.inf))
    keys, lows, highs = map(ordered, (chunk, lowest, highest))
    beyond: Rows = np.zeros(len(chunk), np.bool_)
    for column, least, greatest in zip(keys.T, lows, highs, strict=True):  # faster than all at once
        beyond |= (column < least) | (column > greatest)
    return np.flatnonzero(beyond)


def rows_below(chunk: Rows, limit: float) -> Rows:
    """The indices of rows whose numbers are all below a limit, or nearly so, as `rows_outside`.

    The limit is above 0: the bits of numbers below it are lower then, also of negative ones.
    """
    kind, columns = chunk.dtype.type, chunk.shape[1]
    highest = np.nextafter(np.array([limit], kind), kind(np.inf))
    below = np.ravel(bits(chunk) < bits(highest))
    shifted = (below[column : len(below) - columns + column + 1] for column in range(columns))
    first = np.flatnonzero(reduce(and_, shifted))  # numbers that are below with those after them
    rows: Rows = first[first % columns == 0] // columns
    return rows


def is_finite(chunk: Rows) -> Rows:
    """Which rows contain neither NaN nor infinity."""
    rows: Rows = np.logical_and.reduce(np.isfinite(chunk), axis=1)
    return rows


def squared_norms(chunk: Rows) -> Rows:
    """The squared lengths of rows of four numbers: adding columns is faster than `sum(axis=1)`."""
    wider = chunk.astype(np.float32) if chunk.dtype == np.float16 else chunk
    squares = np.square(wider).reshape(-1, 2)
    sums: Rows = (squares[:, 0] + squares[:, 1]).reshape(-1, 2)
    return sums[:, 0] + sums[:, 1]


def matches_in(chunk: Rows, start: int, selected: Rows) -> Matches | None:
    """The selected rows of a chunk whose first row has the index `start`."""
    count = int(np.count_nonzero(selected))
    if not count:
        return None
    first = int(selected.argmax())
    return Matches(count, start + first, tuple(chunk[first].tolist()))


def join_matches(one: Matches | None, other: Matches | None) -> Matches | None:
    """The matches of two parts of an array, `one` before `other`."""
    if one is None or other is None:
        return one or other
    return Matches(one.count + other.count, one.first, one.value)


def _equal(chunk: Rows, other: Rows) -> Rows:
    """Which rows are equal; further columns are compared only while some row still is."""
    equal: Rows = chunk[:, 0] == other[:, 0]
    for column in range(1, chunk.shape[1]):
        if not equal.any():
            break
        equal &= chunk[:, column] == other[:, column]
    return equal
