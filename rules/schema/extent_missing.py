"""SCH007: without an extent, USD takes a Volume or particle field for empty."""

from usdvol_lint.rule import STAGE, WARNING, Facts, Prim, Problem, Problems, lacks, rule

_MOST_BOXES = 3


@rule("SCH007", on=STAGE, severity=WARNING, since="0.1")
def extent_missing(stage: Prim, facts: Facts) -> Problems:
    prims = [prim for prim in facts.prims.without_extent if not _may_be_elsewhere(prim, facts)]
    volumes = [prim for prim in prims if facts.prims.is_a(prim, "Volume")]
    measured = volumes if len(volumes) <= _MOST_BOXES else []
    for prim in prims:
        box = facts.volumes.fitting_extent(prim) if prim in measured else ""
        yield Problem(
            f"{prim.GetTypeName()} without an extent, so USD takes its bounds for empty",
            at=prim,
            fold="extent",
            suggestion=f"write '{box}'" if box else "author extent, at every time at which the shape changes",
            absent=[lacks(prim, "extent")],
        )


def _may_be_elsewhere(prim: Prim, facts: Facts) -> bool:
    """Whether the extent may lie in a layer that does not open, or has another name."""
    return facts.layers.may_lack_values(prim) or facts.prims.is_told_as_misspelt(prim, "extent")
