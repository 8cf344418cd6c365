"""ARR001: a particle field without positions has no particles."""

from usdvol_lint.rule import WARNING, Facts, Prim, Problem, Problems, rule


@rule("ARR001", on="ParticleField", severity=WARNING, since="0.1")
def positions_empty(particles: Prim, facts: Facts) -> Problems:
    arrays = facts.particles.arrays(particles)
    if not arrays.lack_positions or facts.layers.may_lack_values(particles):
        return
    if any(slip.intended.startswith("positions") for slip in facts.prims.misspelt(particles)):
        return  # SCH004 says it
    yield Problem(
        "no particles at any time",
        at=arrays.positions.attribute if arrays.positions else particles,
        suggestion="author positions, or in half precision positionsh",
    )
