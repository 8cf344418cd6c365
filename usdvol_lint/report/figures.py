"""What a particle field holds, in words: what `--statistics` adds to the text report."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from usdvol_lint.model import ParticleFieldStats

_UNITS = ("bytes", "kB", "MB", "GB")
_STEP = 1000


def figures(stats: ParticleFieldStats) -> Iterator[tuple[str, str]]:
    """The figures of one particle field, each with its label; without those that are not known."""
    yield "holds:", ", ".join(_size(stats))
    if stats.bounds:
        low, high = map(_point, stats.bounds)
        yield "bounds:", f"{low} to {high}"
    if stats.opacity:
        yield "opacity:", "; ".join(_opacity(stats.opacity, stats.transparent))
    if stats.scale:
        yield "scale:", _spread(stats.scale)


def _size(stats: ParticleFieldStats) -> Iterator[str]:
    yield f"{stats.count:,} particle{'' if stats.count == 1 else 's'}"
    if stats.sh_degree is not None:
        yield f"coefficients of degree {stats.sh_degree}"
    if stats.precision:
        precision = "float and half" if stats.precision == "mixed" else stats.precision
        yield f"{_bytes(stats.bytes)} in {precision}"


def _bytes(size: float) -> str:
    unit, *greater = _UNITS
    while greater and size >= _STEP:
        size /= _STEP
        unit, *greater = greater
    return f"{size:,.3g} {unit}" if size < _STEP else f"{size:,.0f} {unit}"


def _point(corner: Sequence[float]) -> str:
    return f"({', '.join(f'{number:.7g}' for number in corner)})"


def _opacity(opacity: Mapping[str, float], transparent: float | None) -> Iterator[str]:
    yield _spread(opacity)
    if transparent:
        yield f"{100 * transparent:.3g} % can't be seen"


def _spread(quantiles: Mapping[str, float]) -> str:
    low, median, high = (f"{quantiles[name]:.4g}" for name in ("min", "p50", "max"))
    return f"{low} to {high}, median {median}"
