"""SCH012: a type in a stronger layer hides a Volume, field or particle field."""

from usdvol_lint.rule import ERROR, INFO, STAGE, UNKNOWN_TYPE, Facts, NotChecked, Prim, Problem, Problems, quoted, rule
from usdvol_lint.schema import FIELD_ASSET
from usdvol_lint.spelling import misspelt_type

_GROUPS = ("Xform", "Scope")


@rule("SCH012", on=STAGE, severity=ERROR, since="0.1")
def type_hidden(stage: Prim, facts: Facts) -> Problems:
    for retyped in facts.layers.retyped:
        prim = retyped.prim
        if facts.layers.may_lack(prim):
            continue
        type_name = prim.GetTypeName()
        what = (
            f"type {type_name!r} hides type {retyped.hidden_type!r}, which the prim has in {quoted(retyped.hidden_in)}"
        )
        if facts.prims.is_a(prim, UNKNOWN_TYPE):
            if not misspelt_type(type_name) and not facts.prims.encoding(prim):
                yield NotChecked(f"{what}; this USD does not know {type_name!r}", at=prim)
            continue
        may_stand_in = not retyped.is_field and type_name not in _GROUPS
        lost = "it is no field" if retyped.is_field else "nothing is drawn"
        if facts.prims.is_a(prim, FIELD_ASSET):
            lost = "its file is one for the hidden type"
        yield Problem(
            what if may_stand_in else f"{what}: {lost}",
            at=prim,
            severity=INFO if may_stand_in else None,
            suggestion=None if may_stand_in else _remedy(retyped.stronger),
        )


def _remedy(stronger: tuple[Prim, ...]) -> str:
    first, *others = stronger
    word = "over" if first.specifier.name == "SpecifierOver" else "def"
    also = f", and in {len(others)} weaker specs too" if others else ""
    return f'leave out the type: {word} "{first.name}"{also}'
