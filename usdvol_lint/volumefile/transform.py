"""Transforms from index space, where voxel centres are integers, to a file's world space."""

from __future__ import annotations

import math
from collections.abc import Iterable
from itertools import product
from typing import NamedTuple, TypeAlias

Point: TypeAlias = tuple[float, float, float]
Bounds: TypeAlias = tuple[Point, Point]
Row: TypeAlias = tuple[float, float, float, float]
Matrix: TypeAlias = tuple[Row, Row, Row, Row]
"""Applied as row vector times matrix, as in USD: the translation is the last row."""


def scale_translate(scale: Iterable[float], translation: Iterable[float] = (0, 0, 0)) -> Matrix:
    """The matrix that scales along the axes, then translates."""
    (a, b, c), (x, y, z) = scale, translation
    return (
        (float(a), 0.0, 0.0, 0.0),
        (0.0, float(b), 0.0, 0.0),
        (0.0, 0.0, float(c), 0.0),
        (float(x), float(y), float(z), 1.0),
    )


IDENTITY: Matrix = scale_translate((1, 1, 1))
"""The identity matrix; that a matrix `is IDENTITY` tells that nothing was multiplied."""


def rows(numbers: tuple[float, ...]) -> Matrix:
    """Sixteen numbers, row by row, as a matrix."""
    a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p = numbers  # noqa: E741
    return (a, b, c, d), (e, f, g, h), (i, j, k, l), (m, n, o, p)


def multiply(first: Matrix, second: Matrix) -> Matrix:
    """The matrix that applies `first`, then `second`."""
    columns = tuple(zip(*second, strict=True))
    return rows(
        tuple(
            sum(x * y for x, y in zip(row, column, strict=True))
            for row in first
            for column in columns
        )
    )


def finite(numbers: Iterable[float]) -> bool:
    return all(map(math.isfinite, numbers))


class Frustum(NamedTuple):
    """The nonlinear part of a frustum map: it makes a box of index space a truncated pyramid."""

    minimum: Point
    maximum: Point
    taper: float
    depth: float

    def apply(self, point: Point) -> Point:
        length_x, length_y, length_z = (
            high - low for low, high in zip(self.minimum, self.maximum, strict=True)
        )
        x = point[0] - self.minimum[0] - length_x / 2
        y = point[1] - self.minimum[1] - length_y / 2
        z = (point[2] - self.minimum[2]) * self.depth / length_z
        scale = ((1 / self.taper - 1) / self.depth * z + 1) / length_x
        return x * scale, y * scale, z

    @property
    def valid(self) -> bool:
        """Whether the numbers are finite and `apply` never divides by zero."""
        numbers = (*self.minimum, *self.maximum, self.taper, self.depth)
        lengths = tuple(high - low for low, high in zip(self.minimum, self.maximum, strict=True))
        return finite(numbers) and 0 not in (*lengths, self.taper, self.depth)


class Transform(NamedTuple):
    """A grid's own transform: the frustum, if there is one, then the matrix.

    `map_type` is what the file calls it; no rule reads it, but the tests compare it with what
    OpenVDB's own tools say.
    """

    map_type: str
    matrix: Matrix
    frustum: Frustum | None = None

    @property
    def linear(self) -> bool:
        return self.frustum is None

    def then(self, matrix: Matrix) -> Transform:
        """This transform followed by a matrix."""
        return self._replace(matrix=multiply(self.matrix, matrix))

    def apply(self, point: Point) -> Point:
        """A point of index space in world space."""
        x, y, z = self.frustum.apply(point) if self.frustum else point
        (a, b, c, _), (d, e, f, _), (g, h, i, _), (s, t, u, _) = self.matrix
        return x * a + y * d + z * g + s, x * b + y * e + z * h + t, x * c + y * f + z * i + u

    def bounds(self, minimum: Point, maximum: Point) -> Bounds:
        """The world box around a box of index space.

        It is the box around the eight corners, which is exact for a frustum too: its scale is
        linear in z.
        """
        if self.frustum is None:
            return _around(self.matrix, minimum, maximum)
        (a, b, c), (d, e, f) = minimum, maximum
        corners = [self.apply(corner) for corner in product((a, d), (b, e), (c, f))]
        (x, u), (y, v), (z, w) = ((min(axis), max(axis)) for axis in zip(*corners, strict=True))
        return (x, y, z), (u, v, w)


def _around(matrix: Matrix, minimum: Point, maximum: Point) -> Bounds:
    """The box around a transformed box, in a third of the time of transforming its corners."""
    (a, b, c), (d, e, f) = minimum, maximum
    lows, highs = [], []
    for x, y, z, start in zip(*matrix, strict=True):
        low = high = start
        for factor, least, most in ((x, a, d), (y, b, e), (z, c, f)):
            if factor > 0:
                low += factor * least
                high += factor * most
            else:
                low += factor * most
                high += factor * least
        lows.append(low)
        highs.append(high)
    return (lows[0], lows[1], lows[2]), (highs[0], highs[1], highs[2])
