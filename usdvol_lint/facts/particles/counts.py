"""Histograms: how often each number occurs in an array, by the upper 16 of its bits."""

from __future__ import annotations

import numpy as np

from usdvol_lint.facts.particles.bits import bits, flip_negative
from usdvol_lint.facts.particles.chunks import Rows

NO_COUNTS: Rows = np.zeros(1 << 16, np.int64)
"""The histogram of nothing: 65,536 integers, indexed by the upper 16 bits as an unsigned number."""


def count_numbers(chunk: Rows) -> Rows:
    """The histogram of a chunk of halfs or floats; NaN and infinity are counted too."""
    upper = bits(chunk).view(f"u{chunk.dtype.itemsize}") >> 8 * (chunk.dtype.itemsize - 2)
    return np.bincount(upper.reshape(-1), minlength=len(NO_COUNTS))


def bins(is_half: bool) -> tuple[Rows, Rows, Rows]:
    """The bins of finite numbers, ascending: their indices, upper ends and middles.

    A bin is a single half, or 65,536 neighbouring floats, which differ by at most a 128th.
    """
    patterns = np.arange(1 << 16, dtype=np.uint16)
    keys = flip_negative(patterns.view(np.int16))
    finite = (
        patterns[np.isfinite(patterns.view(np.float16))]
        if is_half
        else patterns[(patterns & 0x7F80) < 0x7F80]
    )
    order = finite[np.argsort(keys[finite])]
    if is_half:
        numbers = order.view(np.float16).astype(np.float64)
        return order, np.nextafter(numbers, np.inf), numbers
    wide = order.astype(np.uint32) << 16
    edges = wide.view(np.float32).astype(np.float64), (wide | 0xFFFF).view(np.float32)
    middles = (wide | 0x8000).view(np.float32).astype(np.float64)
    return order, np.maximum(*edges), middles
