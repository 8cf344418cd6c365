"""SCH003: a value of another type than the schema declares is none to those who ask for it."""

from usdvol_lint.rule import ERROR, OURS, WARNING, Facts, Prim, Prims, Problem, Problems, When, rule

_ORDER = ", each with its real part first: (w, x, y, z)"


@rule("SCH003", on=OURS, when=When(Prims.may_be_mistyped, bool), severity=ERROR, since="0.1")
def attribute_type_mismatch(prim: Prim, facts: Facts) -> Problems:
    for attribute, spec, found, wanted, only_role in facts.prims.mistyped(prim):
        name = attribute.GetName()
        yield Problem(
            f"{f'{found} {name}'!r} where the schema declares {f'{wanted} {name}'!r}"
            + (": the same values in another role" if only_role else ""),
            at=attribute,
            spec=spec,
            severity=WARNING if only_role else None,
            suggestion=f"author it as {wanted!r}" + _ORDER * ("quat" in wanted and "quat" not in found),
        )
