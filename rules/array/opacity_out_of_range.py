"""ARR008: an opacity goes from 0 to 1."""

from usdvol_lint.rule import ERROR, Facts, ParticleArray, Prim, Problem, Problems, rule

_LOGITS = "these look like the logits of a PLY file: apply the sigmoid, 1 / (1 + exp(-x)), before the export"
_BYTES = "these look like bytes: divide them by 255 before the export"
_PERCENTAGES = "these look like percentages: divide them by 100 before the export"
_EITHER = "these look like bytes or percentages: divide them by 255, or by 100, before the export"
_STRAYS = "clamp them to 0 and 1 before the export"


@rule("ARR008", on="ParticleField", severity=ERROR, since="0.1")
def opacity_out_of_range(particles: Prim, facts: Facts, *, tolerance: float = 1e-3) -> Problems:
    for array in facts.particles.arrays(particles).used("opacities"):
        found = array.outside(-tolerance, 1 + tolerance)
        is_raw = facts.particles.are_raw(array, found)
        is_told = is_raw and array.has_infinity and facts.tells("ARR007")
        if found and array.low and array.high and not is_told:
            (low,), (high,) = array.low, array.high
            yield Problem(
                f"{found.amount} outside of 0 to 1, from {low:.6g} to {high:.6g}, {found.first}",
                at=found,
                suggestion=_LOGITS
                if is_raw
                else _STRAYS
                if found.share <= 0.5 or low < 0 or high > 255
                else _scale(array, high, facts),
            )


def _scale(array: ParticleArray, high: float, facts: Facts) -> str:
    """Bytes are whole numbers, and percentages end at 100."""
    if high > 100:
        return _BYTES
    return _EITHER if facts.particles.are_whole(array) else _PERCENTAGES
