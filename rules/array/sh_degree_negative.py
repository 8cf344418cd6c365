"""ARR005: the degree of spherical harmonics counts from 0."""

from usdvol_lint.rule import ERROR, Facts, Prim, Problem, Problems, rule


@rule("ARR005", on="ParticleField", severity=ERROR, since="0.1")
def sh_degree_negative(particles: Prim, facts: Facts) -> Problems:
    arrays = facts.particles.arrays(particles)
    degree, fitting = arrays.degree, arrays.fitting_degree
    if degree.value is not None and degree.value < 0:
        yield Problem(
            f"degree {degree.value}, which no number of coefficients fits",
            at=degree.attribute,
            suggestion="author a degree from 0 to 3"
            if fitting is None
            else f"author {fitting}, which fits the coefficients",
        )
