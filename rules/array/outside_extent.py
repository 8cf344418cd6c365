"""ARR013: particles outside the extent may be culled while they are in the picture."""

from usdvol_lint.rule import WARNING, Facts, Prim, Problem, Problems, rule


@rule("ARR013", on="ParticleField", severity=WARNING, since="0.1")
def outside_extent(
    particles: Prim, facts: Facts, *, slack: float = 1e-5, half_slack: float = 2**-10, clamp: float = 50_000.0
) -> Problems:
    outside = facts.particles.positions_outside_extent(particles, slack, half_slack, clamp)
    kernels = facts.particles.kernels_outside_extent(particles, 0.0, clamp) if outside else None
    if outside:
        positions = facts.particles.arrays(particles).used("positions")
        yield Problem(
            f"{outside.elements.amount} outside of the extent, {outside.shown_extent}, {outside.elements.first}",
            at=outside,
            against=[array.attribute for array in positions],
            suggestion=f"author at least {outside.shown_with(kernels.fitting)}, which holds their kernels too"
            if kernels
            else f"the positions span {outside.shown_positions}: author at least that",
        )
