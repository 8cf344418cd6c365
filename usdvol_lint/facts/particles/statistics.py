"""Statistics of a particle field, from the histograms made while its arrays were read."""

from __future__ import annotations

import numpy as np

from usdvol_lint.facts.particles.array import ParticleArray
from usdvol_lint.facts.particles.arrays import ParticleArrays
from usdvol_lint.facts.particles.chunks import Row, Rows
from usdvol_lint.facts.particles.counts import bins
from usdvol_lint.model import ParticleFieldStats

_QUANTILES = {"p01": 0.01, "p10": 0.1, "p50": 0.5, "p90": 0.9, "p99": 0.99}
INVISIBLE = 1 / 255
"""The opacity below which renderers skip a particle: the smallest step of an 8-bit display."""
_COLUMNS = {"opacities": 1, "orientations": 4}


def stats_of(prim: str, arrays: ParticleArrays) -> ParticleFieldStats:
    """The statistics of one particle field; `prim` is its path as the stage shows it."""
    used = {array.noun: array for array in arrays.used()}
    positions, opacities, scales = map(used.get, ("positions", "opacities", "scales"))
    kinds = {"half" if array.is_half else "float" for array in used.values()}
    bounds = (positions.low, positions.high) if positions else (None, None)
    return ParticleFieldStats(
        prim=prim,
        count=arrays.most_particles,
        sh_degree=arrays.degree.value if "coefficients" in used else None,
        bytes=sum(map(_bytes, used.values())),
        precision="mixed" if len(kinds) > 1 else next(iter(kinds), None),
        bounds=(_short(bounds[0]), _short(bounds[1])) if bounds[0] and bounds[1] else None,
        opacity=_quantiles(opacities),
        scale=_quantiles(scales),
        transparent=_share_below(opacities, INVISIBLE),
    )


def _bytes(array: ParticleArray) -> int:
    elements = sum(sample.size for sample in array.samples)
    return elements * _COLUMNS.get(array.noun, 3) * (2 if array.is_half else 4)


def _quantiles(array: ParticleArray | None) -> dict[str, float] | None:
    span = array.span if array else None
    if not array or not span:
        return None
    low, high = span
    counts, _, middles = _binned(array)
    below = np.cumsum(counts)
    quantiles = {
        name: float(np.clip(middles[np.searchsorted(below, share * below[-1])], low, high))
        for name, share in _QUANTILES.items()
    }
    named = {"min": low, **quantiles, "max": high}
    return dict(zip(named, _short(tuple(named.values())), strict=True))


def _share_below(array: ParticleArray | None, limit: float) -> float | None:
    if not array or not array.low:
        return None
    counts, ends, _ = _binned(array)
    return float(counts[ends <= limit].sum() / counts.sum())


def _binned(array: ParticleArray) -> tuple[Rows, Rows, Rows]:
    """The histogram of the finite numbers of all samples: counts, upper ends and middles."""
    order, ends, middles = bins(array.is_half)
    return array.counts[order], ends, middles


def _short(row: Row) -> Row:
    """Rounded to the digits of a 32-bit float."""
    return tuple(float(f"{number:.7g}") for number in row)
