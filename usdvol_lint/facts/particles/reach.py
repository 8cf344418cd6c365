"""How far the kernels of particles reach out of the extent, in three standard deviations."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import inf
from typing import Any, NamedTuple

import numpy as np

from usdvol_lint.facts.particles.array import ArraySample, ParticleArray
from usdvol_lint.facts.particles.arrays import ParticleArrays
from usdvol_lint.facts.particles.chunks import Rows, fold
from usdvol_lint.facts.particles.coarseness import largest_scales, rows_at
from usdvol_lint.facts.particles.elements import as_text
from usdvol_lint.facts.particles.extent import limits_of, times_of_extent
from usdvol_lint.facts.particles.matches import is_finite, rows_outside
from usdvol_lint.facts.particles.statistics import INVISIBLE
from usdvol_lint.facts.prims.boxes import union
from usdvol_lint.facts.prims.extents import box_of
from usdvol_lint.facts.usd.steps import Time
from usdvol_lint.facts.usd.values import Value, Values
from usdvol_lint.volumefile import Bounds

_ROUNDING = 1e-5


class Kernel(NamedTuple):
    """How far a kernel of unit scale reaches along each of its first `axes`."""

    radius: float
    axes: int


KERNELS = {
    "ParticleFieldKernelGaussianEllipsoidAPI": Kernel(3.0, 3),
    "ParticleFieldKernelGaussianSurfletAPI": Kernel(3.0, 2),
    "ParticleFieldKernelConstantSurfletAPI": Kernel(1.0, 2),
}


class Reach(NamedTuple):
    """How many of how many kernels reach out of an extent, and the box around these."""

    outside: int
    total: int
    box: Bounds | None

    def plus(self, other: Reach) -> Reach:
        boxes = [box for box in (self.box, other.box) if box]
        return Reach(
            self.outside + other.outside, self.total + other.total, union(boxes) if boxes else None
        )


@dataclass(frozen=True, slots=True)
class KernelsOutside(Values):
    """Samples of positions whose kernels reach out of the extent, as `Reach`, and that extent."""

    extent: Bounds

    @property
    def reach(self) -> Reach:
        """That of all samples together."""
        total = Reach(0, 0, None)
        for reach in self:
            total = total.plus(reach)
        return total

    @property
    def fitting(self) -> Bounds:
        """A box around the extent and all that reaches out of it."""
        box = self.reach.box
        return union([self.extent, box]) if box else self.extent

    @property
    def overhang(self) -> float:
        """How far the farthest kernel reaches out."""
        (low, high), (lowest, highest) = self.extent, self.fitting
        below = (end - begin for begin, end in zip(lowest, low, strict=True))
        return max(*below, *(end - begin for begin, end in zip(high, highest, strict=True)))

    @property
    def shown_extent(self) -> str:
        return _shown(self.extent)

    @property
    def shown_fitting(self) -> str:
        return _shown(self.fitting)


def kernels_outside(
    arrays: ParticleArrays, extent: Any, kernel: Kernel, share: float, clamp: float
) -> KernelsOutside | None:
    """The kernels that reach out of the extent, if one does by a share of its longest side.

    Samples are read only where the bounds of the positions and the greatest scale allow that.
    """
    positions, scales = (next(arrays.used(noun), None) for noun in ("positions", "scales"))
    if not positions or not scales or not scales.low or not scales.high:
        return None
    if min(scales.low) < 0 or not arrays.pairs["scales"].is_known:
        return None
    farthest = kernel.radius * max(scales.high)
    boxes = dict(_boxes(positions, extent, farthest, share, clamp))
    samples = []
    for sample, rows in positions.read(lambda sample: sample.time in boxes):
        limits = limits_of(boxes[sample.time], 0.0, clamp, positions.is_half)
        reach = _reach(arrays, sample, rows, kernel, limits, farthest)
        if reach.outside:
            samples.append(Value(sample.time, reach))
    if not samples:
        return None
    box = union([boxes[sample.time] for sample in samples])
    found = KernelsOutside(positions.attribute, tuple(samples), positions.total, box)
    return found if found.overhang > (1 + _ROUNDING) * share * _longest(box) else None


def _boxes(
    positions: ParticleArray, extent: Any, farthest: float, share: float, clamp: float
) -> Iterator[tuple[Time, Bounds]]:
    """The extent of each sample of positions whose kernels may reach out of it so far."""
    for sample, measured in positions.ranges:
        time = next(iter(times_of_extent(positions, sample, extent)))
        box = box_of(extent.Get() if time is None else extent.Get(time))
        if not box or not measured.low or not measured.high or _longest(box) < 0:
            continue
        low, high = limits_of(box, 0.0, clamp, positions.is_half)
        margin = farthest - share * _longest(box)
        below = (end - margin < side for end, side in zip(measured.low, low, strict=True))
        above = (end + margin > side for end, side in zip(measured.high, high, strict=True))
        if any(below) or any(above):
            yield sample.time, box


def _reach(
    arrays: ParticleArrays,
    sample: ArraySample,
    positions: Rows,
    kernel: Kernel,
    limits: Bounds,
    farthest: float,
) -> Reach:
    """The reach of one sample, in one pass; only kernels near the limits are looked at."""
    scales, opacities, turns = (
        rows_at(next(arrays.used(noun), None), sample, len(positions))
        for noun in ("scales", "opacities", "orientations")
    )
    low, high = np.array(limits, np.float64)

    def measure(chunk: Rows, start: int) -> Reach:
        part = slice(start, start + len(chunk))
        rows = rows_outside(chunk, low + farthest, high - farthest)
        if scales is None or not len(rows):
            return Reach(0, len(chunk), None)
        radii = kernel.radius * largest_scales(scales[part][rows])
        near = _is_outside(chunk[rows], radii[:, np.newaxis], low, high)
        near &= (radii > 0) & (radii < inf) & is_finite(chunk[rows])
        if opacities is not None:
            near &= opacities[part, 0][rows] >= INVISIBLE
        rows = rows[near]
        if not len(rows):
            return Reach(0, len(chunk), None)
        own = None if turns is None else turns[part][rows]
        sides = kernel.radius * _half_sides(scales[part][rows], own, kernel.axes)
        places = chunk[rows].astype(np.float64)
        outside = _is_outside(places, sides, low, high)
        places, sides = places[outside], sides[outside]
        if not len(places):
            return Reach(0, len(chunk), None)
        return Reach(
            len(places), len(chunk), _box((places - sides).min(0), (places + sides).max(0))
        )

    return fold(positions, measure, Reach.plus)


def _is_outside(places: Rows, sides: Rows, low: Rows, high: Rows) -> Rows:
    """Which boxes around places stick out of the limits by more than rounding."""
    slack = _ROUNDING * np.abs(places)
    beyond: Rows = (places - sides < low - slack) | (places + sides > high + slack)
    rows: Rows = np.logical_or.reduce(beyond, axis=1)
    return rows


def _half_sides(scales: Rows, turns: Rows | None, axes: int) -> Rows:
    """Half the sides of the boxes around turned ellipsoids of these radii."""
    radii = scales.astype(np.float64)
    radii[:, axes:] = 0
    if turns is None:
        return radii
    quaternions = turns.astype(np.float64)
    lengths = np.linalg.norm(quaternions, axis=1, keepdims=True)
    with np.errstate(all="ignore"):
        i, j, k, real = np.where(lengths > 0, quaternions / lengths, (0, 0, 0, 1)).T
    matrices = np.array(
        [
            [1 - 2 * (j * j + k * k), 2 * (i * j - k * real), 2 * (i * k + j * real)],
            [2 * (i * j + k * real), 1 - 2 * (i * i + k * k), 2 * (j * k - i * real)],
            [2 * (i * k - j * real), 2 * (j * k + i * real), 1 - 2 * (i * i + j * j)],
        ]
    )
    sides: Rows = np.sqrt(np.einsum("abn,nb->na", matrices**2, radii**2))
    return sides


def _box(low: Rows, high: Rows) -> Bounds:
    (a, b, c), (x, y, z) = low.tolist(), high.tolist()
    return (a, b, c), (x, y, z)


def _longest(box: Bounds) -> float:
    return max(end - begin for begin, end in zip(*box, strict=True))


def _shown(box: Bounds) -> str:
    return f"{as_text(box[0])} to {as_text(box[1])}"
