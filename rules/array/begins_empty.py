"""ARR018: a float array that begins empty is not read at any later time either."""

from usdvol_lint.rule import INFO, Facts, Prim, Problem, Problems, format_time, rule


@rule("ARR018", on="ParticleField", severity=INFO, since="0.1")
def begins_empty(particles: Prim, facts: Facts) -> Problems:
    arrays = facts.particles.arrays(particles)
    if arrays.late_positions or facts.layers.may_lack_values(particles):
        return  # without particles nothing else is read: ARR001
    for array, earliest, filled in arrays.late():
        yield Problem(
            f"{array.name!r} holds nothing at its earliest time, {format_time(earliest)}: the schema permits it, "
            "and OpenUSD does not read it at any time",
            at=array.attribute,
            times=(earliest,),
            suggestion=f"begin its samples at {format_time(filled)}: the first one holds before it too",
        )
