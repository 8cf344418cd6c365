"""PRT006: an API whose name USD does not know is as good as not applied."""

from usdvol_lint.rule import ERROR, WARNING, Facts, Prim, Problem, Problems, rule


@rule("PRT006", on="ParticleField", severity=ERROR, since="0.1")
def unknown_api(particles: Prim, facts: Facts) -> Problems:
    misspelt = facts.particles.apis(particles).misspelt
    if not misspelt or facts.prims.encoding(particles):
        return
    loss = facts.particles.loss(particles, misspelt.values())
    yield Problem(
        f"USD knows no API {', '.join(map(repr, misspelt))}{loss.words}",
        at=particles,
        severity=None if loss.is_total else WARNING,
        suggestion="write " + ", ".join(f"{meant!r} for {name!r}" for name, meant in misspelt.items()),
    )
