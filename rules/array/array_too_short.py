"""ARR002: an array that is shorter than the positions is discarded as a whole."""

from usdvol_lint.rule import ERROR, Facts, Prim, Problem, Problems, rule


@rule("ARR002", on="ParticleField", severity=ERROR, since="0.1")
def array_too_short(particles: Prim, facts: Facts) -> Problems:
    arrays = facts.particles.arrays(particles)
    for array in arrays.used("orientations", "scales", "opacities"):
        short = arrays.too_short(array)
        if short:
            remedy = facts.particles.misfitting_default(particles, array)
            yield Problem(
                short.words,
                at=short,
                suggestion=remedy or "author one element for each position",
            )
