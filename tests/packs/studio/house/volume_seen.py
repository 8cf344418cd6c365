"""STU002: there is a Volume."""

from usdvol_lint.rule import WARNING, Facts, Prim, Problem, Problems, rule


@rule("STU002", on="Volume", severity=WARNING, since="1.0", default=False)
def volume_seen(volume: Prim, facts: Facts) -> Problems:
    yield Problem("seen", at=volume)
