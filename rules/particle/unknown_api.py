"""PRT006: an API whose name USD does not know is as good as not applied."""

from usdvol_lint.rule import APIS, ERROR, WARNING, Facts, Prim, Problem, Problems, rule


@rule("PRT006", on="ParticleField", severity=ERROR, since="0.1")
def unknown_api(particles: Prim, facts: Facts) -> Problems:
    misspelt = facts.particles.apis(particles).misspelt
    if not misspelt or facts.prims.encoding(particles):
        return
    for name, meant in misspelt.items():
        loss = facts.particles.loss(particles, [meant])
        yield Problem(
            f"USD knows no API {name!r}{loss.words}",
            at=particles,
            of=(APIS, name),
            subject=name,
            fold=facts.prims.shown_path(particles),
            severity=None if loss.is_total else WARNING,
            suggestion=f"write {meant!r} for {name!r}",
        )
