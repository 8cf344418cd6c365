"""VOL002: a field relationship must target a field."""

from usdvol_lint.rule import ERROR, TYPE, Facts, NotChecked, Prim, Problem, Problems, TargetState, bindings, lacks, rule
from usdvol_lint.spelling import misspelt_type


@rule(
    "VOL002",
    on="Volume",
    when=bindings(TargetState.NOT_A_FIELD, TargetState.UNKNOWN_TYPE),
    severity=ERROR,
    since="0.1",
)
def target_not_a_field(volume: Prim, facts: Facts) -> Problems:
    bindings = facts.volumes.bindings(volume)
    for binding, target in bindings.with_target(TargetState.NOT_A_FIELD):
        if facts.layers.hides_ours(target.prim):
            continue
        type_name = target.type_name
        meant = facts.volumes.intended_field(binding)
        advice = "target a field, such as an OpenVDBAsset" if type_name else "give it a type, such as 'OpenVDBAsset'"
        yield Problem(
            f"'field:{binding.name}' targets <{target.shown}>, which "
            + (f"is of type {type_name!r}, not a field" if type_name else "has no type"),
            at=binding.property,
            against=[(target.prim, facts.volumes.mistyping(target) or TYPE)],
            suggestion=f"did you mean <{meant}>?" if meant else advice,
            absent=[] if type_name else [lacks(volume, binding.property.GetName())],
        )
    for binding, target in bindings.with_target(TargetState.UNKNOWN_TYPE):
        type_name = target.type_name
        is_reported = facts.prims.encoding(target.prim) or facts.layers.hides_ours(target.prim)
        is_slip = misspelt_type(type_name) and facts.tells("SCH001")
        if not is_slip and not is_reported:
            yield NotChecked(
                f"'field:{binding.name}' targets <{target.shown}> of type {type_name!r}, which no "
                "installed plugin declares",
                at=binding.property,
            )
