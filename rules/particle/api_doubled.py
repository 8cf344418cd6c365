"""PRT009: USD drops a whole list of APIs if one stands in it twice."""

from usdvol_lint.rule import ERROR, WARNING, Facts, Prim, Prims, Problem, Problems, When, rule


@rule(
    "PRT009",
    on="ParticleField",
    severity=ERROR,
    since="0.1",
    when=When(Prims.authored, lambda authored: authored.lacks_apis),
)
def api_doubled(particles: Prim, facts: Facts) -> Problems:
    for dropped in () if facts.prims.encoding(particles) else facts.particles.apis(particles).dropped:
        loss = facts.particles.loss(particles, dropped.names)
        names = ", ".join(map(repr, dropped.doubled))
        listed = ", ".join(f'"{name}"' for name in dropped.names)
        yield Problem(
            f"{names} stands more than once in a list of apiSchemas, and USD drops the whole list{loss.words}",
            at=particles,
            spec=dropped.spec,
            severity=None if loss.is_total else WARNING,
            suggestion=f"write '{dropped.how} apiSchemas = [{listed}]'".replace("' ", "'"),
        )
