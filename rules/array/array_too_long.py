"""ARR003: what an array holds beyond the last position is of no particle."""

from usdvol_lint.rule import WARNING, Facts, Prim, Problem, Problems, rule


@rule("ARR003", on="ParticleField", severity=WARNING, since="0.1")
def array_too_long(particles: Prim, facts: Facts) -> Problems:
    positions = facts.particles.arrays(particles).positions
    for surplus in facts.particles.misfits(particles, are_long=True):
        if surplus.nouns == "coefficients" and facts.tells("ARR004"):
            continue
        if surplus.are_all:
            message = "the end of all arrays is not read"
            advice = "if the end is spare, cut it off; if positions were left out, leave the same out of all arrays"
        else:
            message = "if particles were left out of the other arrays, every later one has the values of another"
            advice = "leave the same particles out of all arrays; cut the end off only if it is spare"
        against = [positions.attribute] if positions else []
        remedy = facts.particles.misfitting_default(particles, surplus.arrays[0])
        yield Problem(f"{surplus.words}: {message}", at=surplus.misfits, against=against, suggestion=remedy or advice)
