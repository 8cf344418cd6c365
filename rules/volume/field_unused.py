"""VOL012: a field does something only if a Volume targets it."""

from usdvol_lint.rule import INFO, Facts, Prim, Problem, Problems, rule


@rule("VOL012", on="VolumeFieldBase", severity=INFO, since="0.1")
def field_unused(field: Prim, facts: Facts) -> Problems:
    if field.GetPath() in facts.unused_field_paths:
        yield Problem(
            f"no Volume of this stage targets the field {field.GetName()!r}",
            at=field,
            suggestion=f"bind it with 'rel field:{field.GetName()}' on a Volume, or remove it",
        )
