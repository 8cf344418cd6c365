"""Reductions over an array where USD has it in memory: in chunks that stay in cache, in threads."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import cache, reduce
from typing import Any, TypeAlias, TypeVar

import numpy as np

Rows: TypeAlias = np.ndarray[Any, Any]
"""An array of vectors as a view of two dimensions; numbers are vectors of one."""

Row: TypeAlias = tuple[float, ...]
Mask: TypeAlias = Callable[[Rows, int], Rows]
"""Which rows of a chunk are meant, as one boolean each; also told where the chunk begins."""

_T = TypeVar("_T")

_CHUNK = 1 << 17
_READ_ONCE = 1 << 20
"""How many numbers in a chunk: one that is read several times has to stay in the cache."""
_WORTH_THREADS = 1 << 22
"""How many numbers in an array, before threads pay."""
_MOST_THREADS = 8
_FOLD = 128
_HALF_INFINITY = 0x7C00
_HALF_MINUS_INFINITY = 0xFC00

NO_COUNTS: Rows = np.zeros(1 << 16, np.int64)


@dataclass(frozen=True, slots=True)
class Spot:
    """Rows of one kind in an array: how many, and the first one with its place."""

    count: int
    first: int
    value: Row


@dataclass(frozen=True, slots=True)
class Range:
    """The least and greatest finite number in each column, None where there is none.

    `non_finite` are the rows with NaN or infinity in them, `has_infinity` and `has_nan` say which.
    `counts` are of all numbers, by the first 16 of their bits.
    """

    low: Row | None
    high: Row | None
    non_finite: Spot | None = None
    has_infinity: bool = False
    has_nan: bool = False
    counts: Rows | None = None


def rows_of(value: Any) -> Rows:
    """A VtArray as a view, without a copy."""
    array = np.asarray(value)
    return array.reshape(len(array), -1)


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
    return fold(rows, _measure_finiteness, _join_ranges, _READ_ONCE)


def bins(is_half: bool) -> tuple[Rows, Rows, Rows]:
    """The places of finite numbers in `counts` by their size, where each ends, and its middle.

    Half numbers are counted one by one; of a float a bin holds 65,536, a 128th of them apart.
    """
    bits = np.arange(1 << 16, dtype=np.uint16)
    keys = _flip_negative(bits.view(np.int16))
    finite = bits[np.isfinite(bits.view(np.float16))] if is_half else bits[(bits & 0x7F80) < 0x7F80]
    order = finite[np.argsort(keys[finite])]
    if is_half:
        numbers = order.view(np.float16).astype(np.float64)
        return order, np.nextafter(numbers, np.inf), numbers
    wide = order.astype(np.uint32) << 16
    edges = wide.view(np.float32).astype(np.float64), (wide | 0xFFFF).view(np.float32)
    middles = (wide | 0x8000).view(np.float32).astype(np.float64)
    return order, np.maximum(*edges), middles


def spot(rows: Rows, mask: Mask) -> Spot | None:
    """The rows that a mask picks, in one pass."""

    def measure(chunk: Rows, start: int) -> Spot | None:
        return _spot_in(chunk, start, mask(chunk, start))

    return fold(rows, measure, _join_spots)


def repetitions(rows: Rows) -> Spot | None:
    """The rows that are the same as the next one, bit by bit, in one pass."""
    bits, following = _bits(rows[:-1]), _bits(rows[1:])
    found = spot(bits, lambda chunk, start: _equal(chunk, following[start : start + len(chunk)]))
    return found and Spot(found.count, found.first, tuple(rows[found.first].tolist()))


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


def joined(pick: Callable[[float, float], float], rows: Iterable[Row | None]) -> Row | None:
    """The least or greatest number in each column; None where no row has any."""
    return reduce(lambda one, other: _join_rows(pick, one, other), rows, None)


def fold(
    rows: Rows,
    measure: Callable[[Rows, int], _T],
    join: Callable[[_T, _T], _T],
    size: int = _CHUNK,
) -> _T:
    """What `measure` says of each chunk, which is told where it begins, joined in their order."""
    step = max(1, size // rows.shape[1])
    starts = range(0, len(rows), step)

    def run(part: range) -> _T:
        with np.errstate(all="ignore"):
            return reduce(join, (measure(rows[start : start + step], start) for start in part))

    threads = _threads()
    if rows.size < _WORTH_THREADS or threads is None:
        return run(starts)
    # More parts than threads: one that has to wait for the disk does not hold up the others.
    share = -(-len(starts) // (8 * _processors()))
    parts = [starts[first : first + share] for first in range(0, len(starts), share)]
    return reduce(join, threads.map(run, parts))


def _measure_columns(chunk: Rows, start: int) -> Range:
    low, high = _column_extremes(_ordered(chunk))
    lows, highs = _numbers(low, chunk), _numbers(high, chunk)
    if np.isfinite(lows).all() and np.isfinite(highs).all():
        return Range(tuple(lows.tolist()), tuple(highs.tolist()))
    return _without_non_finite(chunk, start, _measure_columns)


def _measure_and_count(chunk: Rows, start: int) -> Range:
    bits = _bits(chunk).view(f"u{chunk.dtype.itemsize}") >> 8 * (chunk.dtype.itemsize - 2)
    counts = np.bincount(bits.reshape(-1), minlength=len(NO_COUNTS))
    return replace(_measure_columns(chunk, start), counts=counts)


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
        bits = _bits(chunk)  # NaN and infinity are above all others of their sign
        clean = bits.max() < _HALF_INFINITY and bits.view(np.uint16).max() < _HALF_MINUS_INFINITY
    else:
        clean = np.isfinite(np.add.reduce(chunk, axis=None))
    if clean or np.isfinite(chunk).all():
        return Range(None, None)
    return _without_non_finite(chunk, start, _measure_finiteness)


def _without_non_finite(chunk: Rows, start: int, measure: Callable[[Rows, int], Range]) -> Range:
    """What to say of a chunk with NaN or infinity in it: where these are, and of the rest."""
    finite = is_finite(chunk)
    found = _spot_in(chunk, start, ~finite)
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


def _ordered(chunk: Rows) -> Rows:
    """Numbers that are ordered as those of the chunk: halfs as integers, which are far quicker."""
    return _flip_negative(chunk.view(np.int16)) if chunk.dtype == np.float16 else chunk


def _numbers(keys: Rows, chunk: Rows) -> Rows:
    """The numbers that such keys stand for."""
    return _flip_negative(keys).view(np.float16) if chunk.dtype == np.float16 else keys


def _flip_negative(keys: Rows) -> Rows:
    """From the bits of halfs, a sign and a magnitude, to integers in their order, and back."""
    flipped: Rows = keys >> 15
    flipped &= 0x7FFF
    flipped ^= keys
    return flipped


def _equal(chunk: Rows, other: Rows) -> Rows:
    """Which rows are equal; other columns than the first are asked only where it says so."""
    equal: Rows = chunk[:, 0] == other[:, 0]
    for column in range(1, chunk.shape[1]):
        if not equal.any():
            break
        equal &= chunk[:, column] == other[:, column]
    return equal


def _bits(rows: Rows) -> Rows:
    return rows.view(np.dtype(f"i{rows.dtype.itemsize}"))


def _spot_in(chunk: Rows, start: int, picked: Rows) -> Spot | None:
    count = int(np.count_nonzero(picked))
    if not count:
        return None
    first = int(picked.argmax())
    return Spot(count, start + first, tuple(chunk[first].tolist()))


def _join_spots(one: Spot | None, other: Spot | None) -> Spot | None:
    if one is None or other is None:
        return one or other
    return Spot(one.count + other.count, one.first, one.value)


def _join_ranges(one: Range, other: Range) -> Range:
    return Range(
        _join_rows(min, one.low, other.low),
        _join_rows(max, one.high, other.high),
        _join_spots(one.non_finite, other.non_finite),
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


def _processors() -> int:
    """How many threads may run at once: a container may own fewer processors than the machine."""
    affinity = getattr(os, "sched_getaffinity", None)
    owned = len(affinity(0)) if affinity else os.cpu_count() or 1
    return min(owned, _MOST_THREADS)


@cache
def _threads() -> ThreadPoolExecutor | None:
    return ThreadPoolExecutor(_processors()) if _processors() > 1 else None
