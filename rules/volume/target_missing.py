"""VOL001: the prim that a field relationship targets must exist."""

from usdvol_lint.rule import ERROR, Facts, NotChecked, Prim, Problem, Problems, TargetState, bindings, lacks, rule


@rule("VOL001", on="Volume", when=bindings(TargetState.MISSING, TargetState.UNLOADED), severity=ERROR, since="0.1")
def target_missing(volume: Prim, facts: Facts) -> Problems:
    bindings = facts.volumes.bindings(volume)
    for binding, target in bindings.with_target(TargetState.MISSING):
        meant = facts.volumes.intended_field(binding)
        yield Problem(
            f"'field:{binding.name}' targets <{target.shown}>, and there is no such prim",
            at=binding.property,
            suggestion=f"did you mean <{meant}>?" if meant else "target a field that is there, or remove it",
            absent=[lacks(volume, binding.property.GetName())],
        )
    for binding, target in bindings.with_target(TargetState.UNLOADED):
        yield NotChecked(
            f"'field:{binding.name}' targets <{target.shown}>, which lies in a payload that was not loaded",
            at=binding.property,
        )
