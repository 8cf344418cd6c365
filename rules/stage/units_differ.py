"""STG009: a layer's up axis and units should be the stage's, or be corrected for."""

from typing import Any

from usdvol_lint.rule import INFO, STAGE, WARNING, Facts, Prim, Problem, Problems, quoted, rule


@rule("STG009", on=STAGE, severity=WARNING, since="0.1")
def units_differ(root: Prim, facts: Facts) -> Problems:
    told: set[str] = set()
    for unlike in facts.layers.unlike_stage:
        where = f" (on {len(unlike.prims)} prims)" if len(unlike.prims) > 1 else ""
        said, deed = _compared(unlike)
        top = "the root"
        if unlike.resetting:
            top = f"<{facts.prims.shown_path(unlike.resetting)}>, which resets the transform stack,"
        yield Problem(
            f"{said}, and nothing from the prim up to {top} {deed} it{where}",
            at=unlike.prim,
            spec=unlike.blamed,
            subject=f"{unlike.key} {unlike.layer.GetDisplayName()}",
            fold=f"{unlike.key} {unlike.layer.identifier}",
            severity=INFO if unlike.is_sublayer else None,
            suggestion=None if unlike.is_sublayer else _advice(told, *unlike.remedies),
        )


def _compared(unlike: Any) -> tuple[str, str]:
    """What differs, and what would make up for it."""
    own, other = unlike.said, unlike.stage_says
    if unlike.key == "upAxis":
        return f"the layer's upAxis is {quoted(own)} and the stage's is {quoted(other)}", "rotates"
    return f"the layer's metersPerUnit is {own:g} and the stage's is {other:g}", "scales"


def _advice(told: set[str], first: Any, *others: Any) -> str:
    order = f"{first.name!r} in its xformOpOrder too" if first.path in told else quoted(first.order)
    told.add(first.path)
    where = ", in the layer that has its reference or payload" if first.is_in_instance else ""
    more = f" (and on {len(others)} more accordingly)" if others else ""
    return f"write {quoted(first.op)} on <{first.path}>{where}, with {order}{more}"
