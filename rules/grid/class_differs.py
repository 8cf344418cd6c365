"""GRD006: a field's class must be that of its grid."""

from usdvol_lint.rule import INFO, WARNING, Content, Facts, Prim, Problem, Problems, contents, rule

_CLAIMS = ("levelSet", "fogVolume", "staggered")
_UNSAID = "set the class of the grid where the file is written"


def _difference(content: Content) -> tuple[str, str] | None:
    """The two classes; Field3D has none."""
    claimed, held = content.claim.field_class, content.field_class
    file = content.file
    if claimed not in _CLAIMS or not content.grid or not file or file.format == "field3d":
        return None
    return None if held == claimed else (claimed, held)


@rule("GRD006", on="FieldAsset", when=contents(_difference), severity=WARNING, since="0.1")
def class_differs(field: Prim, facts: Facts) -> Problems:
    for (claimed, held), content, found in facts.grids.contents(field).grouped(_difference):
        known = held != "unknown"
        what = f"is of class {content.written_class!r}" if known else "does not say its class"
        yield Problem(
            f"fieldClass is {claimed!r}, but grid {content.label} in {found.shown} {what}{found.count}",
            at=found,
            against=[field.GetAttribute(name) for name in ("fieldName", "fieldIndex", "fieldClass")],
            suggestion=f"author fieldClass {held!r}, or correct the grid" if known else _UNSAID,
            severity=None if known else INFO,
        )
