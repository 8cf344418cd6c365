"""SCH005: an attribute with a list of allowed tokens holds one of them."""

from usdvol_lint.rule import ERROR, OURS, STAGE, WARNING, Facts, Prim, Prims, Problem, Problems, When, rule
from usdvol_lint.spelling import misspelt_token

_EFFECTS = {
    "purpose": ", so it is in no purpose and not drawn",
    "visibility": ", so it stays visible",
}
"""What a token of UsdGeom's that is none comes to, on the prim and all below it."""


@rule("SCH005", on=(*OURS, STAGE), when=When(Prims.may_have_unlisted_tokens, bool), severity=ERROR, since="0.1")
def token_not_allowed(prim: Prim, facts: Facts) -> Problems:
    for each in facts.prims.above_ours if prim.IsPseudoRoot() else (prim,):
        for name, token, allowed, values in facts.prims.unlisted_tokens(each):
            if each != prim and not facts.prims.is_handed_down(each, name):
                continue
            meant = misspelt_token(name, token, allowed)
            effect = "" if facts.prims.is_a(each, "VolumeFieldBase") else _EFFECTS.get(name, "")
            yield Problem(
                f"{each.GetTypeName()} allows no {name} {token!r}{effect}{values.count}",
                at=values,
                subject=token,
                severity=None if name == "fieldDataType" else WARNING,
                suggestion=f"did you mean {meant!r}?" if meant else f"use one of {', '.join(map(repr, allowed))}",
            )
