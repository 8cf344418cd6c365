"""SCH012: a type in a stronger layer hides a Volume, field or particle field."""

from usdvol_lint.rule import ERROR, INFO, STAGE, UNKNOWN_TYPE, Facts, NotChecked, Prim, Problem, Problems, quoted, rule
from usdvol_lint.schema import BUILT_IN_APIS, FIELD_ASSET, PARTICLE_FIELD, TYPE_NAME
from usdvol_lint.spelling import misspelt_type

_IF_NOT_MEANT = "leave it, if it is to be drawn in its place; if not, "


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
                yield NotChecked(f"{what}; this USD does not know {type_name!r}", at=prim, of=TYPE_NAME)
            continue
        lost = "it is no field" if retyped.is_field else "nothing is drawn"
        if retyped.is_field and facts.prims.is_a(prim, FIELD_ASSET):
            lost = "its file is one for the hidden type"
        elif retyped.hidden_type in BUILT_IN_APIS and facts.prims.is_a(prim, PARTICLE_FIELD):
            lost = "the APIs that are built into it are gone"
        yield Problem(
            what if retyped.stands_in else f"{what}: {lost}",
            at=prim,
            of=TYPE_NAME,
            severity=INFO if retyped.stands_in else None,
            suggestion=_IF_NOT_MEANT * retyped.stands_in + _remedy(retyped.stronger),
        )


def _remedy(stronger: tuple[Prim, ...]) -> str:
    first, *others = stronger
    word = "over" if first.specifier.name == "SpecifierOver" else "def"
    also = f", and in {len(others)} weaker specs too" if others else ""
    return f'leave out the type: {word} "{first.name}"{also}'
