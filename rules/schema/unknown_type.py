"""SCH001: a prim whose type USD does not know is nothing to USD."""

from usdvol_lint.rule import UNKNOWN_TYPE, WARNING, Facts, Prim, Problem, Problems, rule
from usdvol_lint.spelling import misspelt_type


@rule("SCH001", on=UNKNOWN_TYPE, severity=WARNING, since="0.1")
def unknown_type(prim: Prim, facts: Facts) -> Problems:
    meant = misspelt_type(prim.GetTypeName())
    if meant and not facts.prims.encoding(prim):
        yield Problem(
            f"USD knows no type {prim.GetTypeName()!r}",
            at=prim,
            suggestion=f"did you mean {meant!r}?",
        )
