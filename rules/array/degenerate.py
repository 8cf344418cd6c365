"""ARR014: particles that can't be seen, or not be told from others, only cost time."""

from usdvol_lint.rule import INFO, WARNING, Facts, Prim, Problem, Problems, rule


@rule("ARR014", on="ParticleField", severity=WARNING, since="0.1")
def degenerate(particles: Prim, facts: Facts, *, many: float = 0.1) -> Problems:
    if facts.particles.arrays(particles).most_particles == 1:
        return  # a placeholder
    unseen = facts.particles.unseen(particles)
    if unseen:
        yield Problem(
            unseen.words,
            at=unseen.attribute,
            subject="unseen",
            severity=None if unseen.lopsided_share > many else INFO,
            suggestion="leave these particles out of the export, in all arrays",
        )
    copies = facts.particles.copies(particles, unseen)
    if copies:
        yield Problem(
            copies.words,
            at=copies.attribute,
            subject="copies",
            severity=None if copies.share > many else INFO,
            suggestion=("author positions in float, if half made them alike; " if copies.are_half else "")
            + "leave out what is padding or was exported twice, in all arrays: "
            "where it is not opaque, the picture becomes a little thinner",
        )
