"""FLD008: a field has no extent, its Volume has."""

from usdvol_lint.rule import INFO, Facts, Prim, Problem, Problems, rule


@rule("FLD008", on="VolumeFieldBase", severity=INFO, since="0.1")
def extent_on_field(field: Prim, facts: Facts) -> Problems:
    if "extent" not in facts.authored(field).strange:
        return
    extent = field.GetAttribute("extent")
    if extent.HasAuthoredValue():
        yield Problem(
            "extent on a field, where nobody reads it",
            at=extent,
            suggestion="author it on the Volume that has the field",
        )
