"""ARR012: of a float and a half array only one is ever read."""

from usdvol_lint.rule import INFO, WARNING, Facts, Prim, Problem, Problems, rule


@rule("ARR012", on="ParticleField", severity=WARNING, since="0.1")
def half_hidden(particles: Prim, facts: Facts) -> Problems:
    arrays = facts.particles.arrays(particles)
    for pair in arrays.pairs.values():
        if not pair.used or not pair.hidden:
            continue
        used, hidden = pair.used.name, pair.hidden.name
        differs = arrays.size_difference(pair.used, pair.hidden)
        if pair.hidden.is_half:
            message = f"{used!r} counts, so {hidden!r} is never read"
            message += f"; they differ in size: {differs}" if differs else ""
        else:
            message = f"{hidden!r} is empty at the earliest time, so {used!r} counts at all times"
        yield Problem(
            message,
            at=pair.hidden.attribute,
            severity=None if differs else INFO,
            suggestion="author only one of them",
        )
