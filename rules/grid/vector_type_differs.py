"""GRD007: a field's role hint must fit what its grid says of its vectors."""

from usdvol_lint.rule import (
    WARNING,
    Content,
    Facts,
    Prim,
    Problem,
    Problems,
    contents,
    quoted,
    rule,
)

_CLAIMS = ("Point", "Normal", "Vector", "Color")


def _difference(content: Content) -> object:
    claimed, fitting = content.claim.role_hint, content.role_hints
    if claimed not in _CLAIMS or not fitting or claimed in fitting:
        return None
    return claimed, content.grid.vector_type


@rule("GRD007", on="FieldAsset", when=contents(_difference), severity=WARNING, since="0.1")
def vector_type_differs(field: Prim, facts: Facts) -> Problems:
    for content, found in facts.contents(field).grouped(_difference):
        grid = content.grid
        yield Problem(
            f"vectorDataRoleHint is {content.claim.role_hint!r}, but the vectors of grid "
            f"{quoted(grid.label)} in {found.shown} are {grid.vector_type!r}{found.count}",
            at=found.attribute,
            times=found.times,
            at_default=found.at_default,
            asset=found.first.authored,
            suggestion=f"author vectorDataRoleHint {content.role_hints[0]!r}, or correct the grid",
        )
