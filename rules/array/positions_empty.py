"""ARR001: a particle field without positions has no particles, and without first ones draws none."""

from usdvol_lint.rule import CLIPS, WARNING, Facts, Prim, Problem, Problems, format_time, lacks, rule


@rule("ARR001", on="ParticleField", severity=WARNING, since="0.1")
def positions_empty(particles: Prim, facts: Facts) -> Problems:
    arrays = facts.particles.arrays(particles)
    late = arrays.late_positions
    if not (arrays.lack_positions or late) or facts.layers.may_lack_values(particles, "positions"):
        return
    is_misspelt = facts.particles.is_told_as_misspelt(particles, "positions")
    if is_misspelt or (not late and facts.layers.hides_ours(particles)):
        return
    if late:
        filled = format_time(late.filled)
        yield Problem(
            f"'positions' holds nothing at its earliest time, {format_time(late.earliest)}: the schema permits it, "
            f"and OpenUSD draws no particle at any time, not those from {filled} on either",
            at=late.array.attribute,
            times=(late.earliest,),
            suggestion=f"begin the samples of all arrays at {filled}, and until then author visibility 'invisible'",
        )
        return
    if arrays.emptied:
        message, advice = emptied(arrays.emptied.is_from_clips)
        of = CLIPS if arrays.emptied.is_from_clips else None
        yield Problem(message, at=arrays.emptied.attribute, of=of, suggestion=advice)
        return
    yield Problem(
        "no particles at any time",
        at=arrays.positions.attribute if arrays.positions else particles,
        suggestion="author positions, or in half precision positionsh",
        absent=[lacks(particles, "positions")],
    )


def emptied(from_clips: bool) -> tuple[str, str]:
    """What to say of time samples without particles, which hide a default that has some."""
    if from_clips:
        where = "the value clips"
        advice = "write positions into the clips as time samples, or take them out of the manifest"
    else:
        where = "the time samples"
        advice = "author particles in the time samples, or remove these"
    return f"no particles at any time: {where} of 'positions' hold none, and hide its default", advice
