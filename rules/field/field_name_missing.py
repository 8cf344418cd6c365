"""FLD001: a field must say which of the fields in its file it is."""

from usdvol_lint.rule import WARNING, Facts, Grids, Prim, Problem, Problems, When, rule


@rule(
    "FLD001",
    on="FieldAsset",
    when=When(Grids.claims, lambda claims: not all(claim.name for claim in claims.all)),
    severity=WARNING,
    since="0.1",
)
def field_name_missing(field: Prim, facts: Facts) -> Problems:
    name = field.GetAttribute("fieldName")
    names = {name.Get(), *map(name.Get, name.GetTimeSamples())}
    if any(names) or ("" not in names and name.HasAuthoredValue()):
        return
    if not facts.grids.contents(field).timeline.single_grid and not facts.layers.may_lack_values(field):
        yield Problem(
            "fieldName is empty" if "" in names else "no fieldName",
            at=name if name.IsAuthored() else field,
            suggestion="author the name that the field has in its file, such as 'density'",
        )
