"""Reads the sizes of the arrays of a particle field, and decides which of each pair is used."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Collection, Mapping, Sequence
from math import inf, nextafter
from typing import TYPE_CHECKING, Any, TypeAlias

from pxr import Usd, Vt

from usdvol_lint.facts.particles.arrays import COEFFICIENTS, POSITIONS, Degree, Pair, ParticleArrays
from usdvol_lint.facts.usd.values import sample_times

if TYPE_CHECKING:
    from usdvol_lint.facts.particles.array import ParticleArray

Times: TypeAlias = str | int
"""Which time samples are read: `all`, `first`, `ends`, or a number of them, evenly spread."""

_DEGREE = "radiance:sphericalHarmonicsDegree"
_FALLBACK_DEGREE = 3
_PAIRS: dict[str, tuple[Any, Any]] = {
    POSITIONS: (Vt.Vec3fArray, Vt.Vec3hArray),
    "orientations": (Vt.QuatfArray, Vt.QuathArray),
    "scales": (Vt.Vec3fArray, Vt.Vec3hArray),
    "opacities": (Vt.FloatArray, Vt.HalfArray),
    COEFFICIENTS: (Vt.Vec3fArray, Vt.Vec3hArray),
}
"""The names of the float arrays; their types, and those of the half arrays that go with them."""
_TYPES = {
    f"{name}{suffix}": wanted
    for name, pair in _PAIRS.items()
    for suffix, wanted in zip(("", "h"), pair, strict=True)
}


def read_particle_arrays(
    prim: Any,
    schemas: Collection[str],
    authored: Collection[str],
    mistyped: Collection[str],
    times: Times,
    with_counts: bool,
    advance: Callable[[int], None],
) -> ParticleArrays:
    """Reads the sizes of the arrays of a particle field at the chosen times, not their elements.

    `schemas` are those that the prim answers to; `authored` names the attributes that these
    declare, `mistyped` those with another type; `with_counts` and `advance` go to `ParticleArray`.
    """
    names = [name for name in _TYPES if name in authored]
    sampled = {name: sample_times(prim.GetAttribute(name)) for name in names}
    compared = chosen_times(sorted({time for own in sampled.values() for time in own}), times)
    arrays = {
        name: _read_array(prim.GetAttribute(name), sampled[name], compared, with_counts, advance)
        for name in names
    }
    pairs = {name: _pair(name, arrays) for name in _PAIRS}
    degree = _read_degree(prim, authored, mistyped)
    return ParticleArrays(pairs, degree, tuple(compared), schemas)


def chosen_times(times: Sequence[float], policy: Times) -> Sequence[float]:
    """The times that a policy chooses, in order."""
    named = {"all": len(times), "first": 1, "ends": 2}
    count = policy if isinstance(policy, int) else named[policy]
    if count >= len(times):
        return times
    if count == 1:
        return times[:1]
    last = len(times) - 1
    return [times[round(number * last / (count - 1))] for number in range(count)]


def _read_array(
    attribute: Any,
    times: Sequence[float],
    compared: Sequence[float],
    with_counts: bool,
    advance: Callable[[int], None],
) -> ParticleArray | None:
    """The array with the samples in force at the compared times; None if it is mistyped."""
    # NumPy's import costs start-up time, and a particle field without arrays needs none.
    from usdvol_lint.facts.particles.array import ArraySample, ParticleArray

    own = sorted({times[max(bisect_right(times, time) - 1, 0)] for time in compared if times})
    wanted = _TYPES[attribute.GetName()]
    get = Usd.AttributeQuery(attribute).Get
    samples = []
    for time in (None, *own):
        value = attribute.Get() if time is None else get(time)
        if time is None and value is None and own:
            continue
        if time is not None and not value:
            time, value = _as_rounded(get, time, value)
        if value is not None and not isinstance(value, wanted):
            return None
        size = 0 if value is None else len(value)
        samples.append(ArraySample(time, size, is_blocked=value is None))
    return ParticleArray(attribute, tuple(samples), len(times), with_counts, advance)


def _as_rounded(get: Callable[[float], Any], time: float, value: Any) -> tuple[float, Any]:
    """A sample without elements; or, where a layer's scale rounds the time down, the one meant.

    At a time that is a little less in its layer, USD gives the sample before.
    """
    after = nextafter(time, inf)
    meant = get(after)
    return (after, meant) if meant else (time, value)


def _pair(name: str, arrays: Mapping[str, ParticleArray | None]) -> Pair:
    """Chooses as USD's imaging does: float if it has elements at the earliest time, else half."""
    authored = [arrays[spelt] for spelt in (name, f"{name}h") if spelt in arrays]
    known = tuple(array for array in authored if array)
    used = hidden = None
    if known:
        used, *others = known
        if others and others[0].is_populated:
            hidden = others[0]
            if not used.begins_populated:
                used, hidden = hidden, used if used.is_populated else None
    return Pair(known, used, hidden, len(known) == len(authored))


def _read_degree(prim: Any, authored: Collection[str], mistyped: Collection[str]) -> Degree:
    attribute = prim.GetAttribute(_DEGREE)
    if _DEGREE in mistyped:
        return Degree(attribute, None, True)
    if _DEGREE not in authored:
        return Degree(attribute, _FALLBACK_DEGREE, False)
    value = attribute.Get(Usd.TimeCode.EarliestTime())
    return Degree(attribute, _FALLBACK_DEGREE if value is None else value, value is not None)
