"""ARR024: each of many particles is small beside the whole that they make up."""

from usdvol_lint.rule import INFO, Facts, Prim, Problem, Problems, rule

_MANY = 1000


@rule("ARR024", on="ParticleField", severity=INFO, since="0.1")
def scales_too_large(particles: Prim, facts: Facts) -> Problems:
    scales = facts.particles.scales(particles)
    if (
        not scales
        or scales.array.most < _MANY
        or scales.low < 0
        or (scales.are_spread_as_exp and facts.tells("ARR019"))
    ):
        return
    side = facts.prims.limits(particles).longest_side
    if 0 < side < 10 * scales.high and scales.mean > side / 10:
        yield Problem(
            f"the mean of all scales, {scales.mean:.3g}, is more than a tenth of the extent, {side:.6g}",
            at=scales.array.attribute,
            against=[particles.GetAttribute("extent")],
            suggestion="see whether scales and positions have the same unit, and exp was applied once",
        )
