"""VOL005: a field relationship must target a prim, not one of its properties."""

from usdvol_lint.rule import ERROR, Facts, Prim, Problem, Problems, TargetState, bindings, rule


@rule("VOL005", on="Volume", when=bindings(TargetState.PROPERTY), severity=ERROR, since="0.1")
def target_is_a_property(volume: Prim, facts: Facts) -> Problems:
    for binding, target in facts.volumes.bindings(volume).with_target(TargetState.PROPERTY):
        meant = facts.volumes.intended_field(binding)
        if meant and target.shown.startswith(f"{meant}."):
            suggestion = f"target the prim <{meant}>"
        else:
            suggestion = f"did you mean <{meant}>?" if meant else "target the field prim"
        yield Problem(
            f"'field:{binding.name}' targets the property <{target.shown}>, not a field prim",
            at=binding.property,
            against=[target.instancing] if target.instancing else [],
            suggestion=suggestion,
        )
