"""Boxes in the space of a Volume: how far one sticks out of another, and an extent as text."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import TypeAlias

from usdvol_lint.volumefile import Bounds

_AXES = "xyz"
_DIGITS = 6
_MOST_DECIMALS = 300

Sides: TypeAlias = tuple[tuple[str, float], ...]
"""The sides on which a box sticks out, such as `-x`, and how far."""
AXES = len(_AXES)


def magnitude(box: Bounds) -> float:
    """The largest coordinate, without its sign."""
    (a, b, c), (x, y, z) = box
    return max(abs(a), abs(b), abs(c), abs(x), abs(y), abs(z))


def encloses(limit: Bounds, box: Bounds, slack: float) -> bool:
    """Whether a box sticks out of another by no more than `slack` on any side."""
    (a, b, c), (d, e, f) = limit
    (x, y, z), (u, v, w) = box
    return (
        a - slack <= x
        and b - slack <= y
        and c - slack <= z
        and u <= d + slack
        and v <= e + slack
        and w <= f + slack
    )


def sides_outside(limit: Bounds, box: Bounds, slack: float) -> Sides:
    """The sides on which a box sticks out of another by more than `slack`."""
    (low, high), (lowest, highest) = limit, box
    amounts = {
        **{f"-{axis}": edge - end for axis, edge, end in zip(_AXES, low, lowest, strict=True)},
        **{f"+{axis}": end - edge for axis, edge, end in zip(_AXES, high, highest, strict=True)},
    }
    return tuple((side, amount) for side, amount in amounts.items() if amount > slack)


def extent_around(boxes: Iterable[Bounds]) -> str:
    """An extent around boxes, as in a layer, rounded outward to a few digits."""
    lows, highs = zip(*boxes, strict=True)
    low = [min(axis) for axis in zip(*lows, strict=True)]
    high = [max(axis) for axis in zip(*highs, strict=True)]
    largest = max(map(abs, (*low, *high))) or 1.0
    decimals = min(_DIGITS - 1 - math.floor(math.log10(largest)), _MOST_DECIMALS)
    ends = (
        [_rounded(number, decimals, math.floor) for number in low],
        [_rounded(number, decimals, math.ceil) for number in high],
    )
    return "[" + ", ".join(f"({', '.join(end)})" for end in ends) + "]"


def _rounded(number: float, decimals: int, outward: Callable[[float], int]) -> str:
    # Rounding first forgives the last bit, which would add a whole step.
    steps = outward(round(number * 10.0**decimals, 3))
    return f"{steps / 10.0**decimals + 0.0:.9g}"
