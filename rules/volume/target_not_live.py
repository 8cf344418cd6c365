"""VOL008: the target of a field relationship must be active, defined and concrete."""

from usdvol_lint.rule import ERROR, Facts, Prim, Problem, Problems, TargetState, bindings, lacks, rule

_WHY = {
    TargetState.INACTIVE: ("inactive", "activate <{}>"),
    TargetState.OVER: ("an 'over' that nothing defines", "define <{}> with 'def'"),
    TargetState.ABSTRACT: ("an abstract 'class'", "target a prim that inherits <{}>"),
}


@rule("VOL008", on="Volume", when=bindings(*_WHY), severity=ERROR, since="0.1")
def target_not_live(volume: Prim, facts: Facts) -> Problems:
    for binding, target in facts.volumes.bindings(volume).with_target(*_WHY):
        below = "" if target.blamed_path == target.shown else f" below <{target.blamed_path}>"
        yield Problem(
            f"'field:{binding.name}' targets <{target.shown}>{below}, which is {_WHY[target.state][0]}",
            at=binding.property,
            against=[target.reason],
            suggestion=_WHY[target.state][1].format(target.blamed_path),
            absent=[lacks(volume, binding.property.GetName())] if target.state is TargetState.OVER else (),
        )
