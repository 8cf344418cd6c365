"""The ranges of the numbers in an array, and the rows with NaN or infinity, in one pass."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import reduce
from typing import NamedTuple

import numpy as np

from usdvol_lint.facts.particles.bits import bits, numbers, ordered
from usdvol_lint.facts.particles.chunks import READ_ONCE, Row, Rows, fold
from usdvol_lint.facts.particles.counts import count_numbers
from usdvol_lint.facts.particles.matches import (
    Matches,
    is_finite,
    join_matches,
    matches_in,
    squared_norms,
)

_FOLD = 128
"""How many rows are viewed as one."""
_HALF_INFINITY = 0x7C00
_HALF_MINUS_INFINITY = 0xFC00


class Range(NamedTuple):
    """The least and greatest number in each column, of the rows that are finite.

    `low` and `high` are None if no row is, or if they were not asked for; `non_finite` are the rows
    with NaN or infinity; `counts` is a histogram of all numbers, if one was asked for.
    """

    low: Row | None
    high: Row | None
    non_finite: Matches | None = None
    has_infinity: bool = False
    has_nan: bool = False
    counts: Rows | None = None


def column_range(rows: Rows) -> Range:
    """The range of each column, in one pass."""
    return fold(rows, _measure_columns, _join_ranges)


def counted_column_range(rows: Rows) -> Range:
    """The range of each column and a histogram, in one pass."""
    return fold(rows, _measure_and_count, _join_ranges)


def norm_range(rows: Rows) -> Range:
    """The range of the squared lengths of rows of four numbers, in one pass."""
    return fold(rows, _measure_norms, _join_ranges)


def finiteness(rows: Rows) -> Range:
    """The rows with NaN or infinity, in one pass; the ranges of columns are left out."""
    return fold(rows, _measure_finiteness, _join_ranges, READ_ONCE)


def joined(pick: Callable[[float, float], float], rows: Iterable[Row | None]) -> Row | None:
    """`pick` of each column, such as `min`; None where all rows are None."""
    return reduce(lambda one, other: _join_rows(pick, one, other), rows, None)


def _measure_columns(chunk: Rows, start: int) -> Range:
    low, high = _column_extremes(ordered(chunk))
    lows, highs = numbers(low, chunk), numbers(high, chunk)
    if np.isfinite(lows).all() and np.isfinite(highs).all():
        return Range(tuple(lows.tolist()), tuple(highs.tolist()))
    return _without_non_finite(chunk, start, _measure_columns)


def _measure_and_count(chunk: Rows, start: int) -> Range:
    return _measure_columns(chunk, start)._replace(counts=count_numbers(chunk))


def _measure_norms(chunk: Rows, start: int) -> Range:
    norms = squared_norms(chunk)
    low, high = float(norms.min()), float(norms.max())
    if np.isfinite(low) and np.isfinite(high):
        return Range((low,), (high,))
    if np.isfinite(chunk).all():  # the squares overflowed
        return _measure_norms(chunk.astype(np.float64), start)
    return _without_non_finite(chunk, start, _measure_norms)


def _measure_finiteness(chunk: Rows, start: int) -> Range:
    """A sum is NaN or infinite if a number is; it may also overflow, so that is then checked."""
    if chunk.dtype == np.float16:
        values = bits(chunk)  # NaN and infinity are above all others of their sign
        clean = (
            values.max() < _HALF_INFINITY and values.view(np.uint16).max() < _HALF_MINUS_INFINITY
        )
    else:
        clean = np.isfinite(np.add.reduce(chunk, axis=None))
    if clean or np.isfinite(chunk).all():
        return Range(None, None)
    return _without_non_finite(chunk, start, _measure_finiteness)


def _without_non_finite(chunk: Rows, start: int, measure: Callable[[Rows, int], Range]) -> Range:
    """The range of a chunk's finite rows, with the rows that contain NaN or infinity."""
    finite = is_finite(chunk)
    matches = matches_in(chunk, start, ~finite)
    rest = chunk[finite]
    inner = measure(rest, start) if len(rest) else Range(None, None)
    infinity, nan = bool(np.isinf(chunk).any()), bool(np.isnan(chunk).any())
    return Range(inner.low, inner.high, matches, infinity, nan)


def _column_extremes(keys: Rows) -> tuple[Rows, Rows]:
    """The least and the greatest key in each column.

    Many short rows are viewed as few long ones, which NumPy reduces many times as fast.
    """
    wide = len(keys) // _FOLD * _FOLD
    if not wide:
        return keys.min(axis=0), keys.max(axis=0)
    folded = keys[:wide].reshape(-1, _FOLD * keys.shape[1])
    low = folded.min(axis=0).reshape(_FOLD, -1).min(axis=0)
    high = folded.max(axis=0).reshape(_FOLD, -1).max(axis=0)
    if wide < len(keys):
        low = np.minimum(low, keys[wide:].min(axis=0))
        high = np.maximum(high, keys[wide:].max(axis=0))
    return low, high


def _join_ranges(one: Range, other: Range) -> Range:
    return Range(
        _join_rows(min, one.low, other.low),
        _join_rows(max, one.high, other.high),
        join_matches(one.non_finite, other.non_finite),
        one.has_infinity or other.has_infinity,
        one.has_nan or other.has_nan,
        None if one.counts is None or other.counts is None else one.counts + other.counts,
    )


def _join_rows(
    pick: Callable[[float, float], float], one: Row | None, other: Row | None
) -> Row | None:
    if one is None or other is None:
        return one or other
    return tuple(map(pick, one, other))
