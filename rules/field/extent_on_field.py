"""FLD008: a field has no extent, its Volume has."""

from usdvol_lint.rule import INFO, Facts, Prim, Prims, Problem, Problems, When, rule

_HAS_EXTENT = When(Prims.authored, lambda authored: "extent" in authored.undeclared)


@rule("FLD008", on="VolumeFieldBase", when=_HAS_EXTENT, severity=INFO, since="0.1")
def extent_on_field(field: Prim, facts: Facts) -> Problems:
    extent = field.GetAttribute("extent")
    if extent.HasAuthoredValue() and not facts.layers.hides_ours(field):
        yield Problem(
            "extent on a field, where nobody reads it",
            at=extent,
            suggestion="author it on the Volume that has the field",
        )
