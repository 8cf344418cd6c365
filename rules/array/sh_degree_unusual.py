"""ARR006: renderers support spherical harmonics up to degree 3."""

from usdvol_lint.rule import INFO, Facts, Prim, Problem, Problems, rule


@rule("ARR006", on="ParticleField", severity=INFO, since="0.1")
def sh_degree_unusual(particles: Prim, facts: Facts, *, largest: int = 3) -> Problems:
    arrays = facts.particles.arrays(particles)
    degree, fitting = arrays.degree, arrays.fitting_degree
    if degree.value is None or degree.value <= largest:
        return
    if fitting not in (None, degree.value) and facts.tells("ARR004"):
        return
    yield Problem(
        f"degree {degree.value}, where renderers go up to {largest}",
        at=degree.attribute,
        suggestion=f"leave out what is above degree {largest}",
    )
