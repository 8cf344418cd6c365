"""GRD004: a field's index must not go beyond the grids of its name."""

from usdvol_lint.rule import ERROR, Content, Facts, Prim, Problem, Problems, contents, quoted, rule


def _missing(content: Content) -> object:
    index, count = content.claim.index, len(content.grids)
    if index is None or not count or index < count or not content.file.complete:
        return None
    return index, count, content.grids[0].unique_name


@rule("GRD004", on="FieldAsset", when=contents(_missing), severity=ERROR, since="0.1")
def grid_index_missing(field: Prim, facts: Facts) -> Problems:
    for content, found in facts.contents(field).grouped(_missing):
        index, count = content.claim.index, len(content.grids)
        name = content.grids[0].unique_name
        many = "1 grid" if count == 1 else f"{count} grids"
        yield Problem(
            f"fieldIndex is {index}, but {found.shown} holds {many} named {quoted(name)}"
            f"{found.count}",
            at=found.attribute,
            times=found.times,
            at_default=found.at_default,
            asset=found.first.authored,
            suggestion=f"count from 0: the last one is {count - 1}",
        )
