"""GRD012: Storm draws no grid that stands in a frustum where it is."""

from usdvol_lint.rule import WARNING, Content, Facts, Prim, Problem, Problems, contents, quoted, rule


def _nonlinear(content: Content) -> str | None:
    grid = content.grid
    return grid.label if grid and grid.transform and not grid.transform.linear else None


@rule("GRD012", on="FieldAsset", when=contents(_nonlinear), severity=WARNING, since="0.1")
def transform_nonlinear(field: Prim, facts: Facts) -> Problems:
    for label, _, found in facts.grids.contents(field).grouped(_nonlinear):
        yield Problem(
            f"grid {quoted(label)} in {found.shown} "
            f"has a frustum for its transform, and Storm draws it as if it had none{found.count}",
            at=found,
            suggestion="resample it to a grid with a linear transform",
        )
