"""GRD009: one grid of the file, and no other, should answer to the field's name."""

from usdvol_lint.rule import WARNING, Content, Facts, Prim, Problem, Problems, contents, quoted, rule


def _ambiguity(content: Content) -> tuple[str, str] | None:
    grids, grid, claim = content.grids, content.grid, content.claim
    if grid is None:
        return None
    if len(grids) > 1 and claim.index is None:
        name, purposes = grid.unique_name, sorted({other.purpose or "" for other in grids})
        if len(purposes) > 1:
            listed = ", ".join(map(repr, purposes))
            return (
                f"grids named {quoted(name)} in {listed}",
                "author the fieldPurpose that is meant",
            )
        return (
            f"{len(grids)} grids named {quoted(name)}, and the field has no fieldIndex",
            "author the fieldIndex that is meant, from 0 in the order of the file",
        )
    if grid.name != grid.unique_name:
        return (
            f"a grid listed as {quoted(grid.unique_name)} whose own metadata name it {quoted(grid.name)}",
            "write the file again: readers go by the one or the other",
        )
    return None


@rule("GRD009", on="FieldAsset", when=contents(_ambiguity), severity=WARNING, since="0.1")
def grid_name_ambiguous(field: Prim, facts: Facts) -> Problems:
    for (reason, suggestion), _, found in facts.grids.contents(field).grouped(_ambiguity):
        yield Problem(
            f"{found.shown} holds {reason}{found.count}",
            at=found,
            against=[field.GetAttribute("fieldName")],
            suggestion=suggestion,
        )
