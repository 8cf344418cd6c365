"""ARR013: particles outside the extent may be culled while they are in the picture."""

from usdvol_lint.rule import WARNING, Facts, Prim, Problem, Problems, rule


@rule("ARR013", on="ParticleField", severity=WARNING, since="0.1")
def outside_extent(
    particles: Prim,
    facts: Facts,
    *,
    slack: float = 1e-5,
    half_slack: float = 2**-10,
    clamp: float = 50_000.0,
) -> Problems:
    for array in facts.particles.arrays(particles).used("positions"):
        strays = facts.particles.positions_outside_extent(particles, half_slack if array.is_half else slack, clamp)
        if strays:
            yield Problem(
                f"{strays.found.amount} outside of the extent, {strays.shown_extent}, {strays.found.first}",
                at=strays,
                suggestion=f"the positions span {strays.shown_positions}: author at least that",
            )
