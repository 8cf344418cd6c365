"""The ranges of the numbers in an array, and where it holds NaN or infinity, in one pass."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import reduce

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
_HALF_INFINITY = 0x7C00
_HALF_MINUS_INFINITY = 0xFC00


@dataclass(frozen=True, slots=True)
class Range:
    """The least and greatest finite number in each column, None where there is none.

    `non_finite` are the rows with NaN or infinity in them, `has_infinity` and `has_nan` say which.
    `counts` are of all numbers, by the first 16 of their bits.
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
    """The same with counts."""
    return fold(rows, _measure_and_count, _join_ranges)


def norm_range(rows: Rows) -> Range:
    """The range of the squared lengths of the rows, which have four numbers each, in one pass."""
    return fold(rows, _measure_norms, _join_ranges)


def finiteness(rows: Rows) -> Range:
    """Only whether all is finite, in one pass; the columns' ranges are left out."""
    return fold(rows, _measure_finiteness, _join_ranges, READ_ONCE)


def joined(pick: Callable[[float, float], float], rows: Iterable[Row | None]) -> Row | None:
    """The least or greatest number in each column; None where no row has any."""
    return reduce(lambda one, other: _join_rows(pick, one, other), rows, None)


def _measure_columns(chunk: Rows, start: int) -> Range:
    low, high = _column_extremes(ordered(chunk))
    lows, highs = numbers(low, chunk), numbers(high, chunk)
    if np.isfinite(lows).all() and np.isfinite(highs).all():
        return Range(tuple(lows.tolist()), tuple(highs.tolist()))
    return _without_non_finite(chunk, start, _measure_columns)


def _measure_and_count(chunk: Rows, start: int) -> Range:
    return replace(_measure_columns(chunk, start), counts=count_numbers(chunk))


def _measure_norms(chunk: Rows, start: int) -> Range:
    norms = squared_norms(chunk)
    low, high = float(norms.min()), float(norms.max())
    if np.isfinite(low) and np.isfinite(high):
        return Range((low,), (high,))
    if np.isfinite(chunk).all():  # only the squares were too large
        return _measure_norms(chunk.astype(np.float64), start)
    return _without_non_finite(chunk, start, _measure_norms)


def _measure_finiteness(chunk: Rows, start: int) -> Range:
    """NaN and infinity poison a sum; a sum may also be too large, so they are looked for then."""
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
    """What to say of a chunk with NaN or infinity in it: where these are, and of the rest."""
    finite = is_finite(chunk)
    found = matches_in(chunk, start, ~finite)
    rest = chunk[finite]
    inner = measure(rest, start) if len(rest) else Range(None, None)
    infinity, nan = bool(np.isinf(chunk).any()), bool(np.isnan(chunk).any())
    return Range(inner.low, inner.high, found, infinity, nan)


def _column_extremes(keys: Rows) -> tuple[Rows, Rows]:
    """The extremes of each column of a chunk.

    Narrow columns are folded into wide rows, because NumPy reduces those many times as fast.
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
