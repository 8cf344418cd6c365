"""ARR009: a scale is a size along an axis, not its logarithm."""

from usdvol_lint.rule import ERROR, WARNING, Facts, Prim, Problem, Problems, rule


@rule("ARR009", on="ParticleField", severity=ERROR, since="0.1")
def scale_negative(particles: Prim, facts: Facts) -> Problems:
    for array in facts.particles.arrays(particles).used("scales"):
        found = array.outside(0.0, float("inf"))
        is_raw = facts.particles.are_raw(array, found)
        is_told = is_raw and array.has_infinity and facts.tells("ARR007")
        if found and array.low and array.high and not is_told:
            low, high, are_most = min(array.low), max(array.high), found.share > 0.5
            yield Problem(
                f"{found.amount} below 0, from {low:.6g} to {high:.6g}, {found.first}",
                at=found,
                severity=None if are_most else WARNING,
                suggestion="these look like the logarithms of a PLY file: apply exp(x) before the export"
                if is_raw
                else "author sizes from 0",
            )
