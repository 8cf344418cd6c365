"""STG002: the stage must compose without errors."""

from usdvol_lint.rule import STAGE, WARNING, Facts, Prim, Problem, Problems, rule


@rule("STG002", on=STAGE, severity=WARNING, since="0.1")
def composition_error(root: Prim, facts: Facts) -> Problems:
    for error in facts.layers.errors:
        where = f" (on {len(error.prims)} prims)" if len(error.prims) > 1 else ""
        advice = "correct what it names: USD goes on without it"
        yield Problem(error.message + where, at=error.prim, spec=error.spec, suggestion=advice)
