"""GRD012: few renderers draw a grid that stands in a frustum."""

from usdvol_lint.rule import (
    WARNING,
    Content,
    Facts,
    Prim,
    Problem,
    Problems,
    contents,
    quoted,
    rule,
)


def _nonlinear(content: Content) -> object:
    transform = content.grid and content.grid.transform
    return content.grid.label if transform and not transform.linear else None


@rule("GRD012", on="FieldAsset", when=contents(_nonlinear), severity=WARNING, since="0.1")
def transform_nonlinear(field: Prim, facts: Facts) -> Problems:
    for content, found in facts.contents(field).grouped(_nonlinear):
        yield Problem(
            f"grid {quoted(content.grid.label)} in {found.shown} has a frustum for its transform"
            f"{found.count}",
            at=found.attribute,
            times=found.times,
            at_default=found.at_default,
            asset=found.first.authored,
            suggestion="resample it to a grid with a linear transform",
        )
