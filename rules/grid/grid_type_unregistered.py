"""GRD011: OpenVDB as it comes must know the types of all grids in a file."""

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


def _unregistered(content: Content) -> tuple[str, str] | None:
    grids = content.file.grids if content.file else ()
    unknown = (grid for grid in grids if not grid.registered)
    return next(((grid.label, grid.tree_type) for grid in unknown), None)


@rule("GRD011", on="FieldAsset", when=contents(_unregistered), severity=WARNING, since="0.1")
def grid_type_unregistered(field: Prim, facts: Facts) -> Problems:
    for content, found in facts.contents(field).grouped(_unregistered):
        label, tree_type = _unregistered(content)
        yield Problem(
            f"grid {quoted(label)} in {found.shown} is of type {tree_type!r}, "
            f"for which OpenVDB refuses the whole file{found.count}",
            at=found.attribute,
            times=found.times,
            at_default=found.at_default,
            asset=found.first.authored,
            suggestion="leave the grid out, or write it as float, int32 or vec3s with 5_4_3 nodes",
        )
