"""ARR026: between times at which an array holds something there should be none at which it does not."""

from usdvol_lint.rule import INFO, Facts, Prim, Problem, Problems, frame_ranges, rule


@rule("ARR026", on="ParticleField", severity=INFO, since="0.1")
def hole_in_time(particles: Prim, facts: Facts) -> Problems:
    if facts.layers.may_lack_values(particles):
        return
    for hole in facts.particles.arrays(particles).holes():
        yield Problem(
            f"{hole.words} nothing at {frame_ranges(hole.times)}: blocked there, and neither before nor after",
            at=hole.arrays[0].attribute,
            times=hole.times,
            suggestion="write the samples that are missing, or leave it, if nothing is to be seen then",
        )
