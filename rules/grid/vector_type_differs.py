"""GRD007: a field's role hint must fit what its grid says of its vectors."""

from usdvol_lint.rule import WARNING, Content, Facts, Prim, Problem, Problems, contents, rule

_CLAIMS = ("Point", "Normal", "Vector", "Color")


def _difference(content: Content) -> tuple[str, str] | None:
    claimed, fitting, grid = content.claim.role_hint, content.role_hints, content.grid
    is_told = claimed in _CLAIMS and fitting and claimed not in fitting
    return (claimed, grid.vector_type) if is_told and grid else None


@rule("GRD007", on="FieldAsset", when=contents(_difference), severity=WARNING, since="0.1")
def vector_type_differs(field: Prim, facts: Facts) -> Problems:
    for (claimed, held), content, found in facts.grids.contents(field).grouped(_difference):
        yield Problem(
            f"vectorDataRoleHint is {claimed!r}, but the vectors of grid {content.label} in "
            f"{found.shown} are {held!r}{found.count}",
            at=found,
            against=[field.GetAttribute(name) for name in ("fieldName", "fieldIndex", "vectorDataRoleHint")],
            suggestion=f"author vectorDataRoleHint {content.role_hints[0]!r}, or correct the grid",
        )
