"""FLD004: an index counts from 0."""

from usdvol_lint.rule import ERROR, Facts, Prim, Problem, Problems, authored, rule


@rule("FLD004", on="FieldAsset", when=authored("fieldIndex"), severity=ERROR, since="0.1")
def field_index_negative(field: Prim, facts: Facts) -> Problems:
    values = facts.prims.values(field, "fieldIndex")
    for index, held in values.grouped(lambda value: value if type(value) is int and value < 0 else None):
        yield Problem(
            f"fieldIndex {index} is negative: it counts the grids of one name from 0{held.count}",
            at=held,
            suggestion="author 0 for the first grid of that name, or remove it",
        )
