"""ARR014: particles that can't be seen, or not be told from others, only cost time."""

from usdvol_lint.rule import INFO, WARNING, Facts, Prim, Problem, Problems, rule


@rule("ARR014", on="ParticleField", severity=WARNING, since="0.1")
def degenerate(particles: Prim, facts: Facts, *, many: float = 0.1) -> Problems:
    arrays = facts.particles.arrays(particles)
    if arrays.most_particles == 1:
        return  # a placeholder
    looked_for = (
        *(("of no size along two axes", array.zeros(2)) for array in arrays.used("scales")),
        *(("of 0", array.zeros()) for array in arrays.used("opacities")),
        *(("the same as the next", array.repetitions()) for array in arrays.used("positions")),
    )
    for what, found in looked_for:
        if found:
            yield Problem(
                f"{found.amount} {what}, {found.first}",
                at=found,
                severity=None if found.share > many else INFO,
                suggestion="leave these particles out of the export, in all arrays",
            )
