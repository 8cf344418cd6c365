"""GRD011: OpenVDB as it comes must know the types of all grids in a file."""

from usdvol_lint.rule import WARNING, Content, Facts, Prim, Problem, Problems, contents, quoted, rule


def _unregistered(content: Content) -> tuple[str, str] | None:
    grids = content.file.grids if content.file else ()
    unknown = (grid for grid in grids if not grid.registered)
    return next(((grid.label, grid.tree_type) for grid in unknown), None)


@rule("GRD011", on="FieldAsset", when=contents(_unregistered), severity=WARNING, since="0.1")
def grid_type_unregistered(field: Prim, facts: Facts) -> Problems:
    for (label, tree_type), _, found in facts.grids.contents(field).grouped(_unregistered):
        yield Problem(
            f"grid {quoted(label)} in {found.shown} is of type {tree_type!r}, "
            f"for which OpenVDB refuses the whole file{found.count}",
            at=found,
            fold=facts.files.alike(field),
            suggestion="leave the grid out, or write it as float, int32 or vec3s with 5_4_3 nodes",
        )
