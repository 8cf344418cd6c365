"""GRD004: a field's index must not go beyond the grids of its name."""

from usdvol_lint.rule import ERROR, Content, Facts, Prim, Problem, Problems, contents, quoted, rule


def _missing(content: Content) -> tuple[int, int, str] | None:
    file, index, count = content.file, content.claim.index, len(content.grids)
    is_past = file and file.complete and index is not None and 0 < count <= index
    return (index or 0, count, content.grids[0].unique_name) if is_past else None


@rule("GRD004", on="FieldAsset", when=contents(_missing), severity=ERROR, since="0.1")
def grid_index_missing(field: Prim, facts: Facts) -> Problems:
    for (index, count, name), _, found in facts.grids.contents(field).grouped(_missing):
        many = "1 grid" if count == 1 else f"{count} grids"
        yield Problem(
            f"fieldIndex is {index}, but {found.shown} holds {many} named {quoted(name)}{found.count}",
            at=found,
            against=[field.GetAttribute(name) for name in ("fieldName", "fieldIndex")],
            suggestion=f"count from 0: the last one is {count - 1}",
        )
