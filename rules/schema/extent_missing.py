"""SCH007: without an extent, USD takes a Volume or particle field for empty."""

from usdvol_lint.rule import STAGE, WARNING, Facts, Prim, Problem, Problems, lacks, rule

_NAMED = 20
_MOST_BOXES = 3


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
        suggestion=_boxes(prims, facts) or "author extent, at every time at which the shape changes",
        absent=[lacks(prim, "extent") for prim in prims],
    )


def _boxes(prims: list[Prim], facts: Facts) -> str:
    """The extents to write; empty for many prims, or where one of them is not known."""
    if len(prims) > _MOST_BOXES or not all(facts.prims.is_a(prim, "Volume") for prim in prims):
        return ""
    boxes = [facts.volumes.fitting_extent(prim) for prim in prims]
    if not all(boxes):
        return ""
    places = [f" in <{facts.prims.shown_path(prim)}>" * (len(prims) > 1) for prim in prims]
    written = [f"'{box}'{place}" for box, place in zip(boxes, places, strict=True)]
    return f"write {', '.join(written)}"


def _may_be_elsewhere(prim: Prim, facts: Facts) -> bool:
    """Whether the extent may lie in a layer that does not open, or has another name."""
    return facts.layers.may_lack_values(prim) or facts.prims.is_told_as_misspelt(prim, "extent")
