"""Boxes along the axes: their union, how far one sticks out of another, an extent as text."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import TypeAlias, TypeVar, cast

from usdvol_lint.volumefile import Bounds, IndexBounds

_B = TypeVar("_B", Bounds, IndexBounds)

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


def union(boxes: Iterable[_B]) -> _B:
    """The box around boxes, of which there is at least one."""
    lows, highs = zip(*boxes, strict=True)
    low = tuple(map(min, zip(*lows, strict=True)))
    high = tuple(map(max, zip(*highs, strict=True)))
    return cast("_B", (low, high))


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
    box = union(boxes)
    largest = magnitude(box) or 1.0
    decimals = min(_DIGITS - 1 - math.floor(math.log10(largest)), _MOST_DECIMALS)
    ends = (
        [_rounded(number, decimals, math.floor) for number in box[0]],
        [_rounded(number, decimals, math.ceil) for number in box[1]],
    )
    return "[" + ", ".join(f"({', '.join(end)})" for end in ends) + "]"


def _rounded(number: float, decimals: int, outward: Callable[[float], int]) -> str:
    # Rounding first forgives the last bit, which would add a whole step.
    steps = outward(round(number * 10.0**decimals, 3))
    return f"{steps / 10.0**decimals + 0.0:.9g}"
