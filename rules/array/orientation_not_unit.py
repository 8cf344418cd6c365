"""ARR011: only a quaternion of length 1 is a rotation and nothing else."""

from math import sqrt

from usdvol_lint.rule import WARNING, Facts, Prim, Problem, Problems, rule


@rule("ARR011", on="ParticleField", severity=WARNING, since="0.1")
def orientation_not_unit(
    particles: Prim, facts: Facts, *, tolerance: float = 1e-3, half_tolerance: float = 1e-2
) -> Problems:
    for array in facts.particles.arrays(particles).used("orientations"):
        found = array.not_unit(half_tolerance if array.is_half else tolerance)
        if found and array.low and array.high:
            low, high = sqrt(array.low[0]), sqrt(array.high[0])
            yield Problem(
                f"{found.amount} not of length 1, lengths go from {low:.6g} to {high:.6g}, {found.first}",
                at=found,
                suggestion="divide each quaternion by its length before the export",
            )
