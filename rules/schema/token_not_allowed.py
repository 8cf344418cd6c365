"""SCH005: an attribute with a list of allowed tokens holds one of them."""

from usdvol_lint.rule import ERROR, WARNING, Facts, Prim, Prims, Problem, Problems, When, rule
from usdvol_lint.spelling import misspelt_token


@rule(
    "SCH005",
    on=("VolumeFieldBase", "ParticleField"),
    when=When(Prims.may_have_unlisted_tokens, bool),
    severity=ERROR,
    since="0.1",
)
def token_not_allowed(prim: Prim, facts: Facts) -> Problems:
    for name, token, allowed, values in facts.prims.unlisted_tokens(prim):
        meant = misspelt_token(name, token, allowed)
        yield Problem(
            f"{prim.GetTypeName()} allows no {name} {token!r}{values.count}",
            at=values,
            severity=None if name == "fieldDataType" else WARNING,
            suggestion=f"did you mean {meant!r}?" if meant else f"use one of {', '.join(map(repr, allowed))}",
        )
