"""GRD004: a field's index must not go beyond the grids of its name."""

from usdvol_lint.rule import ERROR, Content, Facts, Prim, Problem, Problems, contents, quoted, rule


def _missing(content: Content) -> tuple[int, int, str] | None:
    file, index, count = content.file, content.claim.index, len(content.grids)
    if not file or index is None or not count or index < count or not file.complete:
        return None
    return index, count, content.grids[0].unique_name


@rule("GRD004", on="FieldAsset", when=contents(_missing), severity=ERROR, since="0.1")
def grid_index_missing(field: Prim, facts: Facts) -> Problems:
    for (index, count, name), _, found in facts.grids.contents(field).grouped(_missing):
        yield Problem(
            f"fieldIndex is {index}, but {found.shown} holds {count} grid{'s' * (count > 1)} named {quoted(name)}{found.count}",
            at=found,
            against=[field.GetAttribute("fieldIndex")],
            suggestion=f"count from 0: the last one is {count - 1}",
        )
