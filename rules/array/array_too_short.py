"""ARR002: an array that is shorter than the positions is discarded as a whole."""

from usdvol_lint.rule import ERROR, Facts, Prim, Problem, Problems, rule


@rule("ARR002", on="ParticleField", severity=ERROR, since="0.1")
def array_too_short(particles: Prim, facts: Facts) -> Problems:
    positions = facts.particles.arrays(particles).positions
    for short in facts.particles.misfits(particles, are_long=False):
        if short.nouns == "coefficients" and facts.tells("ARR004"):
            continue
        message = short.words if len(short.arrays) > 1 else short.misfits.words
        advice = "author one element for each position"
        if short.are_all:
            message = f"{message}: only the positions differ, and none of the others is read"
            advice = "find the particles that the other arrays lack, and leave them out of the positions"
        remedy = facts.particles.misfitting_default(particles, short.arrays[0])
        place = short.at(positions) if short.are_all and positions else short.misfits
        against = [array.attribute for array in (positions, *short.arrays) if array]
        yield Problem(message, at=place, against=against, suggestion=remedy or advice)
