"""FLD005: not every renderer looks at the index of a field."""

from usdvol_lint.rule import INFO, Facts, Prim, Problem, Problems, authored, rule


@rule("FLD005", on="FieldAsset", when=authored("fieldIndex"), severity=INFO, since="0.1")
def field_index_ignored(field: Prim, facts: Facts) -> Problems:
    values = facts.prims.values(field, "fieldIndex")
    for index, held in values.grouped(lambda value: value if type(value) is int and value > 0 else None):
        yield Problem(
            f"fieldIndex {index} is ignored by Storm and others, which read the first grid of that name{held.count}",
            at=held,
            suggestion="give the grids names of their own where renderers must agree",
        )
