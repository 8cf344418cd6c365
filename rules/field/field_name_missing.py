"""FLD001: a field must say which of the fields in its file it is."""

from usdvol_lint.rule import WARNING, Content, Facts, Grids, Prim, Problem, Problems, When, lacks, quoted, rule


def _only_name(content: Content) -> str | None:
    """The name of an OpenVDB file's only grid, if it has one."""
    file = content.file
    if file is None or not file.format == content.wanted == "openvdb":
        return None
    return (file.grids[0].unique_name or None) if file.grids else None


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
    contents = facts.grids.contents(field)
    unasked = list(contents.grouped(_only_name)) if contents.timeline.single_grid else []
    if (contents.timeline.single_grid and not unasked) or facts.layers.may_lack_values(field):
        return
    if facts.prims.is_told_as_misspelt(field, "fieldName"):
        return
    what = "fieldName is empty" if "" in names else "no fieldName"
    advice = "author the name that the field has in its file, such as 'density'"
    if unasked:
        grid, _, found = unasked[0]
        what += f", so Storm asks {found.shown} for a grid named '' and draws nothing"
        advice = f"author fieldName {quoted(grid)}, the name of the only grid in the file"
    if len(unasked) > 1:
        advice = f"author time samples with the name of each file's only grid, {quoted(grid)} for the first"
    yield Problem(
        what,
        at=name if name.IsAuthored() else field,
        suggestion=advice,
        absent=[lacks(field, "fieldName", "filePath")],
    )
