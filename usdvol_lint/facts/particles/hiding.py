"""Defaults that hide samples, where it is for these that another array has its number."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from usdvol_lint.facts.particles.array import ParticleArray
from usdvol_lint.facts.particles.arrays import ParticleArrays
from usdvol_lint.facts.usd.hidden import HiddenAnimation
from usdvol_lint.words import quoted


def misfitting_default(
    array: ParticleArray,
    arrays: ParticleArrays,
    hidden_animation: Callable[[Any], HiddenAnimation | None],
) -> str | None:
    """The default, of an array that does not fit or of the positions, that hides what would fit.

    In words, with what it hides and what to do.  That of the positions is to blame if it fits no
    array at all.
    """
    positions = arrays.positions
    if not positions:
        return None
    wanted: dict[ParticleArray, float] = {array: positions.most * arrays.each(array)}
    if not any(arrays.fit(other) for other in arrays.used() if other is not positions):
        wanted[positions] = array.most / arrays.each(array)
    for default, number in wanted.items():
        hidden = None if default.total else hidden_animation(default.attribute)
        if hidden and {len(value) for value in hidden.values()} == {number}:
            return f"the default of {quoted(default.name)} hides {hidden.words}: remove it"
    return None
