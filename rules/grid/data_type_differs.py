"""GRD005: a field's data type must be that of its grid."""

from usdvol_lint.rule import ERROR, Content, Facts, Prim, Problem, Problems, contents, quoted, rule
from usdvol_lint.schema import ATTRIBUTES

_KNOWN = ATTRIBUTES["OpenVDBAsset"]["fieldDataType"].tokens


def _difference(content: Content) -> object:
    claimed, grid = content.claim.data_type, content.grid
    if claimed not in _KNOWN or grid is None or grid.value_type == "unknown":
        return None
    fits = claimed in content.data_types
    return None if fits else (claimed, grid.value_type, grid.half)


@rule("GRD005", on="FieldAsset", when=contents(_difference), severity=ERROR, since="0.1")
def data_type_differs(field: Prim, facts: Facts) -> Problems:
    for content, found in facts.contents(field).grouped(_difference):
        grid = content.grid
        fitting = content.data_types
        saved = ", saved as half" if grid.half else ""
        yield Problem(
            f"fieldDataType is {content.claim.data_type!r}, but grid {quoted(grid.label)} in "
            f"{found.shown} holds {grid.value_type}{saved}{found.count}",
            at=found.attribute,
            times=found.times,
            at_default=found.at_default,
            asset=found.first.authored,
            suggestion=f"author fieldDataType {fitting[0]!r}"
            if fitting
            else f"remove it: no fieldDataType stands for {grid.value_type}",
        )
