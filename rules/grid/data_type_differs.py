"""GRD005: a field's data type must be that of its grid."""

from usdvol_lint.rule import ERROR, WARNING, Content, Facts, Prim, Problem, Problems, contents, rule
from usdvol_lint.schema import ATTRIBUTES

_KNOWN = ATTRIBUTES["OpenVDBAsset"]["fieldDataType"].tokens

_WIDTHS = (
    {"int", "int64"},
    *({f"{name}{size}" for name in ("half", "float", "double")} for size in ("", "2", "3", "4")),
)
"""Types of the same numbers in other widths: a reader that takes one converts from the other."""


def _difference(content: Content) -> tuple[str, str, bool] | None:
    claimed, grid = content.claim.data_type, content.grid
    if claimed not in _KNOWN or grid is None or grid.value_type == "unknown":
        return None
    fits = claimed in content.data_types
    return None if fits else (claimed, grid.value_type, grid.half)


@rule("GRD005", on="FieldAsset", when=contents(_difference), severity=ERROR, since="0.1")
def data_type_differs(field: Prim, facts: Facts) -> Problems:
    inside = facts.grids.contents(field)
    for (claimed, held, is_half), content, found in inside.grouped(_difference):
        fitting = content.data_types
        saved = ", saved as half" if is_half else ""
        yield Problem(
            f"fieldDataType is {claimed!r}, but grid {content.label} in {found.shown} holds {held}{saved}{found.count}",
            at=found,
            against=[field.GetAttribute(name) for name in ("fieldName", "fieldIndex", "fieldDataType")],
            suggestion=f"author fieldDataType {fitting[0]!r}"
            if fitting
            else f"remove it: no fieldDataType stands for {held}",
            severity=WARNING if _differ_in_width(claimed, fitting) else None,
        )


def _differ_in_width(claimed: str, fitting: tuple[str, ...]) -> bool:
    return any(claimed in widths and not widths.isdisjoint(fitting) for widths in _WIDTHS)
