"""Reductions over arrays of any size, against what NumPy says without them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from particlefields import AS_IT_IS

import usdvol_lint.facts.particles.chunks as chunks
import usdvol_lint.facts.particles.matches as matches
import usdvol_lint.facts.particles.ranges as ranges


@AS_IT_IS
@given(
    count=st.integers(1, 3000),
    width=st.sampled_from([1, 3, 4]),
    dtype=st.sampled_from([np.float16, np.float32]),
    seed=st.integers(0, 2**32 - 1),
    sprinkled=st.lists(
        st.sampled_from([np.nan, np.inf, -np.inf, 0.0, -0.0, 65504.0, -65504.0, 6e-8]), max_size=6
    ),
    chunk=st.sampled_from([1, 7, 1000, 1 << 17]),
    threads=st.booleans(),
)
def test_reductions_agree_with_the_obvious(
    count: int,
    width: int,
    dtype: Any,
    seed: int,
    sprinkled: list[float],
    chunk: int,
    threads: bool,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(chunks, "_CHUNK", chunk * width)
    monkeypatch.setattr(chunks.fold, "__defaults__", (chunk * width,))
    monkeypatch.setattr(chunks, "_WORTH_THREADS", 0 if threads else 1 << 40)
    random = np.random.default_rng(seed)
    rows = (random.standard_normal((count, width)) * 100).astype(dtype)
    for value in sprinkled:
        rows[random.integers(count), random.integers(width)] = value
    rows = rows[random.integers(count, size=count)]  # some of them twice
    finite = np.isfinite(rows).all(axis=1)
    bad = None
    if not finite.all():
        first = int((~finite).argmax())
        bad = matches.Matches(int((~finite).sum()), first, tuple(rows[first].tolist()))
    extremes = None, None
    if finite.any():
        extremes = tuple(rows[finite].min(axis=0)), tuple(rows[finite].max(axis=0))
    flags = bool(np.isinf(rows).any()), bool(np.isnan(rows).any())

    for measured in (ranges.column_range(rows), ranges.counted_column_range(rows)):
        assert (measured.low, measured.high) == extremes
        assert_same_matches(measured.non_finite, bad)
        assert (measured.has_infinity, measured.has_nan) == flags
    assert_same_matches(ranges.finiteness(rows).non_finite, bad)
    if width == 4:
        norms = (rows[finite].astype(np.float64) ** 2).sum(axis=1)
        measured = ranges.norm_range(rows)
        assert_same_matches(measured.non_finite, bad)
        if len(norms):
            assert measured.low == pytest.approx((norms.min(),), rel=1e-5)
            assert measured.high == pytest.approx((norms.max(),), rel=1e-5)
    bits = rows.view(f"i{rows.itemsize}")
    twice = (bits[1:] == bits[:-1]).all(axis=1)
    for keep in (matches.keep_repeated, matches.keep_alike) if count > 1 else ():
        left = np.ones(count - 1, np.bool_)
        keep(left, rows)
        assert left.tolist() == (twice & finite[1:]).tolist()


def assert_same_matches(one: matches.Matches | None, other: matches.Matches | None) -> None:
    """NaN is not equal to itself."""
    assert repr(one) == repr(other)


@pytest.mark.parametrize("dtype", [np.float16, np.float32])
@pytest.mark.parametrize("place", [0, 1, -1])
def test_large_arrays_go_through_threads(dtype: Any, place: int) -> None:
    rows = np.ones((chunks._WORTH_THREADS // 3 + 12345, 3), dtype)
    assert ranges.column_range(rows) == ranges.Range((1, 1, 1), (1, 1, 1))
    rows[place] = (2, -np.inf, 0.5)
    found = matches.Matches(1, place % len(rows), (2, -np.inf, 0.5))
    assert ranges.column_range(rows) == ranges.Range((1, 1, 1), (1, 1, 1), found, has_infinity=True)
    assert ranges.finiteness(rows) == ranges.Range(None, None, found, has_infinity=True)


def test_a_sum_that_overflows_is_no_infinity() -> None:
    rows = np.full((100_000, 3), 3e38, np.float32)
    assert ranges.finiteness(rows).non_finite is None
    assert ranges.norm_range(np.full((10, 4), 3e38, np.float32)).high == pytest.approx((3.6e77,))
