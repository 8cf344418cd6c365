"""ARR022: kernels that reach out of the extent may be culled while they are in the picture."""

from usdvol_lint.rule import INFO, Facts, Prim, Problem, Problems, rule

_SLACK, _HALF_SLACK = 1e-5, 2**-10


@rule("ARR022", on="ParticleField", severity=INFO, since="0.1")
def kernel_outside_extent(particles: Prim, facts: Facts, *, share: float = 0.1, clamp: float = 50_000.0) -> Problems:
    found = facts.particles.kernels_outside_extent(particles, share, clamp)
    if not found or facts.layers.may_lack_values(particles):
        return
    if facts.tells("ARR013") and facts.particles.positions_outside_extent(particles, _SLACK, _HALF_SLACK, clamp):
        return
    extent, fitting = found.shown
    yield Problem(
        f"{found.reach.outside:,} of {found.reach.total:,} kernels reach{'es' * (found.reach.outside == 1)} out of "
        f"the extent, {extent}, by up to {found.overhang:.3g}{found.count}",
        at=particles.GetAttribute("extent"),
        against=[array.attribute for array in facts.particles.arrays(particles).used("positions", "scales")],
        suggestion=f"author at least {fitting}",
    )
