"""FLD002: a field should say what type of data it holds."""

from usdvol_lint.rule import INFO, Facts, Grids, Prim, Problem, Problems, When, lacks, rule


@rule(
    "FLD002",
    on="FieldAsset",
    when=When(Grids.claims, lambda claims: not all(claim.data_type for claim in claims.all)),
    severity=INFO,
    since="0.1",
)
def field_data_type_missing(field: Prim, facts: Facts) -> Problems:
    data_type = field.GetAttribute("fieldDataType")
    if data_type.Get():
        return
    values = list(facts.prims.values(field, "fieldDataType"))
    if any(values) or ("" not in values and data_type.HasAuthoredValue()):
        return
    if facts.grids.contents(field).timeline.lacks_data_type:
        return
    if not facts.layers.may_lack_values(field):
        yield Problem(
            "fieldDataType is empty" if "" in values else "no fieldDataType",
            at=data_type if data_type.IsAuthored() else field,
            suggestion="author the type of the grid, such as 'float' or 'float3'",
            absent=[lacks(field, "fieldDataType")],
        )
