"""Numbers as the integers that their bits spell, which are quicker to compare."""

from __future__ import annotations

import numpy as np

from usdvol_lint.facts.particles.chunks import Rows


def bits(rows: Rows) -> Rows:
    return rows.view(np.dtype(f"i{rows.dtype.itemsize}"))


def ordered(chunk: Rows) -> Rows:
    """Numbers that are ordered as those of the chunk: halfs as integers, which are far quicker."""
    return flip_negative(chunk.view(np.int16)) if chunk.dtype == np.float16 else chunk


def numbers(keys: Rows, chunk: Rows) -> Rows:
    """The numbers that such keys stand for."""
    return flip_negative(keys).view(np.float16) if chunk.dtype == np.float16 else keys


def flip_negative(keys: Rows) -> Rows:
    """From the bits of halfs, a sign and a magnitude, to integers in their order, and back."""
    flipped: Rows = keys >> 15
    flipped &= 0x7FFF
    flipped ^= keys
    return flipped
