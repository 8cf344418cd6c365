"""PRT010: a stronger layer takes APIs away that a particle field needs."""

from typing import Any

from usdvol_lint.rule import ERROR, INFO, WARNING, Facts, Prim, Prims, Problem, Problems, When, rule


@rule(
    "PRT010",
    on="ParticleField",
    severity=ERROR,
    since="0.1",
    when=When(Prims.authored, lambda authored: authored.lacks_apis),
)
def api_removed(particles: Prim, facts: Facts) -> Problems:
    for removed in () if facts.prims.encoding(particles) else facts.particles.apis(particles).removed:
        loss = facts.particles.loss(particles, removed.names)
        how = "'delete apiSchemas'" if removed.is_deletion else "a list of apiSchemas without 'prepend'"
        names = ", ".join(map(repr, removed.names))
        effect = loss.words or f", which leaves {' and '.join(map(repr, removed.unread))} unread"
        yield Problem(
            f"{how} takes away {names}{effect}",
            at=particles,
            spec=removed.spec,
            severity=None if loss.is_total else INFO if removed.is_deletion and not loss.words else WARNING,
            suggestion=_remedy(removed, names),
        )


def _remedy(removed: Any, names: str) -> str:
    if removed.is_deletion:
        return f"leave {names} out of it" if removed.listed else "leave it out"
    if removed.others:
        return f"add {names} to the list"
    listed = ", ".join(f'"{name}"' for name in removed.listed)
    return f"write 'prepend apiSchemas = [{listed}]'" if listed else "leave it out"
