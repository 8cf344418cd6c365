"""SCH007: without an extent, USD takes a Volume or particle field for empty."""

from usdvol_lint.rule import STAGE, WARNING, Facts, Prim, Problem, Problems, lacks, rule

_NAMED = 20


@rule("SCH007", on=STAGE, severity=WARNING, since="0.1")
def extent_missing(stage: Prim, facts: Facts) -> Problems:
    prims = [prim for prim in facts.prims.without_extent if not _may_be_elsewhere(prim, facts)]
    if not prims:
        return
    names = [f"{prim.GetTypeName()} <{facts.prims.shown_path(prim)}>" for prim in prims[:_NAMED]]
    more = f" and {len(prims) - _NAMED} more" if len(prims) > _NAMED else ""
    yield Problem(
        f"no extent, so USD takes the bounds for empty: {', '.join(names)}{more}",
        at=prims[0],
        suggestion="author extent, at every time at which the shape changes",
        absent=[lacks(prim, "extent") for prim in prims],
    )


def _may_be_elsewhere(prim: Prim, facts: Facts) -> bool:
    """Whether the extent may lie in a layer that does not open, or has another name."""
    return facts.layers.may_lack_values(prim) or facts.prims.is_told_as_misspelt(prim, "extent")
