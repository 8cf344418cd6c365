"""STG009: a layer's up axis and units should be the stage's, or be corrected for."""

from typing import Any

from usdvol_lint.rule import INFO, STAGE, WARNING, Facts, Prim, Problem, Problems, quoted, rule


@rule("STG009", on=STAGE, severity=WARNING, since="0.1")
def units_differ(root: Prim, facts: Facts) -> Problems:
    for unlike in facts.layers.unlike_stage:
        where = f" (on {len(unlike.prims)} prims)" if len(unlike.prims) > 1 else ""
        said, deed, advice = _compared(unlike)
        top, what = "the root", "the prim that has the reference or payload"
        if unlike.resetting:
            what = f"<{facts.prims.shown_path(unlike.resetting)}>"
            top = f"{what}, which resets the transform stack,"
        yield Problem(
            f"{said}, and nothing from the prim up to {top} {deed} it{where}",
            at=unlike.prim,
            spec=unlike.layer.pseudoRoot,
            severity=INFO if unlike.is_sublayer else None,
            suggestion=None if unlike.is_sublayer else advice.format(what),
        )


def _compared(unlike: Any) -> tuple[str, str, str]:
    """What differs, what would make up for it, and the advice to do so, with `{}` for a prim."""
    own, other = unlike.said, unlike.stage_says
    if unlike.key == "upAxis":
        said = f"the layer's upAxis is {quoted(own)} and the stage's is {quoted(other)}"
        turn = _TURNS.get((own, other), "the one axis to the other")
        return said, "rotates", "rotate {}: " + turn
    said = f"the layer's metersPerUnit is {own:g} and the stage's is {other:g}"
    return (
        said,
        "scales",
        "scale {} by " + f"{own / other:g}",
    )


_TURNS = {
    ("Z", "Y"): "'float xformOp:rotateX = -90'",
    ("Y", "Z"): "'float xformOp:rotateX = 90'",
}
