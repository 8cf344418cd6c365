"""GRD008: a grid without active voxels shows nothing."""

from usdvol_lint.rule import INFO, Content, Facts, Prim, Problem, Problems, contents, quoted, rule


def _empty(content: Content) -> str | None:
    grid = content.grid
    return grid.label if grid is not None and grid.is_empty else None


@rule("GRD008", on="FieldAsset", when=contents(_empty), severity=INFO, since="0.1")
def grid_empty(field: Prim, facts: Facts) -> Problems:
    for label, _, found in facts.grids.contents(field).grouped(_empty):
        yield Problem(
            f"grid {quoted(label)} in {found.shown} has no active voxels{found.count}",
            at=found,
            suggestion="leave it, if the frame is meant to be empty; otherwise look at the source of the simulation",
        )
