"""PRT006: an API whose name USD does not know is as good as not applied."""

from usdvol_lint.rule import WARNING, Facts, Prim, Problem, Problems, rule


@rule("PRT006", on="ParticleField", severity=WARNING, since="0.1")
def unknown_api(particles: Prim, facts: Facts) -> Problems:
    misspelt = facts.particles.apis(particles).misspelt
    if misspelt and not facts.prims.encoding(particles):
        yield Problem(
            f"USD knows no API {', '.join(map(repr, misspelt))}",
            at=particles,
            suggestion="write " + ", ".join(f"{meant!r} for {name!r}" for name, meant in misspelt.items()),
        )
