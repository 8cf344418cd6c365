"""ARR003: what an array holds beyond the last position is of no particle."""

from usdvol_lint.rule import WARNING, Facts, Prim, Problem, Problems, rule


@rule("ARR003", on="ParticleField", severity=WARNING, since="0.1")
def array_too_long(particles: Prim, facts: Facts) -> Problems:
    arrays = facts.particles.arrays(particles)
    for array in arrays.used("orientations", "scales", "opacities"):
        long = arrays.too_long(array)
        if long:
            default = facts.particles.misfitting_default(particles, array)
            yield Problem(
                long.words,
                at=long,
                suggestion=f"{default}: remove it" if default else "author one element for each position",
            )
