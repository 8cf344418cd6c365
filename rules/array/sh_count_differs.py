"""ARR004: each particle has as many spherical harmonics coefficients as the degree says."""

from usdvol_lint.rule import ERROR, WARNING, Facts, Prim, Problem, Problems, rule


@rule("ARR004", on="ParticleField", severity=ERROR, since="0.1")
def sh_count_differs(particles: Prim, facts: Facts) -> Problems:
    arrays = facts.particles.arrays(particles)
    degree, each, fitting = arrays.degree, arrays.degree.coefficients, arrays.fitting_degree
    authored = "" if degree.is_authored else ", what USD falls back to,"
    if not each:
        return  # ARR005 says it
    for array in arrays.used("coefficients"):
        for misfits, severity in (
            (arrays.too_short(array, each), None),
            (arrays.too_long(array, each), WARNING),
        ):
            if misfits:
                default = facts.particles.misfitting_default(particles, array, each)
                advice = f"author {each:,} coefficient{'s' * (each > 1)} for each position"
                if fitting is not None:
                    advice = f"author radiance:sphericalHarmonicsDegree = {fitting}, which fits"
                yield Problem(
                    f"{misfits.words}, and degree {degree.value}{authored} takes {each:,} for each",
                    at=misfits,
                    severity=severity,
                    suggestion=f"{default}: remove it" if default else advice,
                )
