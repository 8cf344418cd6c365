"""ARR010: a quaternion of no length is no orientation."""

from usdvol_lint.rule import ERROR, Facts, Prim, Problem, Problems, rule


@rule("ARR010", on="ParticleField", severity=ERROR, since="0.1")
def orientation_zero(particles: Prim, facts: Facts) -> Problems:
    for array in facts.particles.arrays(particles).used("orientations"):
        found = array.without_direction()
        if found:
            yield Problem(
                f"{found.amount} of no length, {found.first}",
                at=found,
                suggestion="author (1, 0, 0, 0) where there is no rotation",
            )
