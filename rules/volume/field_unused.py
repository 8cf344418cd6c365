"""VOL012: a field that no Volume targets is drawn by nobody."""

from usdvol_lint.rule import INFO, STAGE, Facts, Prim, Problem, Problems, lacks, rule
from usdvol_lint.schema import FIELD_NAMESPACE


@rule("VOL012", on=STAGE, severity=INFO, since="0.1")
def field_unused(root: Prim, facts: Facts) -> Problems:
    for field in facts.volumes.unused_fields:
        yield Problem(
            f"no Volume of this stage targets the field {field.GetName()!r}",
            at=field,
            holds=facts.volumes.stays_unused(field),
            suggestion=f"bind it with 'rel field:{field.GetName()}' on a Volume, or remove it",
            absent=[lacks(field, FIELD_NAMESPACE)],
        )
