"""ARR018: a float array that begins empty is not read at any later time either."""

from usdvol_lint.rule import INFO, Facts, Prim, Problem, Problems, format_time, rule


@rule("ARR018", on="ParticleField", severity=INFO, since="0.1")
def begins_empty(particles: Prim, facts: Facts) -> Problems:
    arrays = facts.particles.arrays(particles)
    has_none = arrays.late_positions and facts.tells("ARR001")  # so nothing else is read
    if has_none or facts.layers.may_lack_values(particles):
        return
    for array, earliest, filled in arrays.late():
        yield Problem(
            f"{array.name!r} holds nothing at its earliest time, {format_time(earliest)}: the schema permits it, "
            "and OpenUSD does not read it at any time",
            at=array.attribute,
            times=(earliest,),
            suggestion=f"begin its samples at {format_time(filled)}: the first one holds before it too",
        )
