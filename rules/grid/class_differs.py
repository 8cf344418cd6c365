"""GRD006: a field's class must be that of its grid."""

from usdvol_lint.rule import (
    INFO,
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

_CLAIMS = ("levelSet", "fogVolume", "staggered")


def _difference(content: Content) -> object:
    """The two classes; Field3D has none."""
    claimed, held = content.claim.field_class, content.field_class
    if claimed not in _CLAIMS or content.grid is None or content.file.format == "field3d":
        return None
    return None if held == claimed else (claimed, held)


@rule("GRD006", on="FieldAsset", when=contents(_difference), severity=WARNING, since="0.1")
def class_differs(field: Prim, facts: Facts) -> Problems:
    for content, found in facts.contents(field).grouped(_difference):
        held = content.field_class
        known = held != "unknown"
        what = f"is of class {content.grid.grid_class!r}" if known else "does not say its class"
        yield Problem(
            f"fieldClass is {content.claim.field_class!r}, "
            f"but grid {quoted(content.grid.label)} in {found.shown} {what}{found.count}",
            at=found.attribute,
            times=found.times,
            at_default=found.at_default,
            asset=found.first.authored,
            suggestion=f"author fieldClass {held!r}, or correct the grid" if known else None,
            severity=None if known else INFO,
        )
