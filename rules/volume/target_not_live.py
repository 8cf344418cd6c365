"""VOL008: the target of a field relationship must be active, defined and concrete."""

from usdvol_lint.rule import ERROR, Facts, Prim, Problem, Problems, TargetState, bindings, lacking, rule

_WHY = {
    TargetState.INACTIVE: ("inactive", "activate <{}>"),
    TargetState.OVER: ("an 'over' that nothing defines", "define <{}> with 'def'"),
    TargetState.ABSTRACT: ("an abstract 'class'", "target a prim that inherits <{}>"),
}


@rule("VOL008", on="Volume", when=bindings(*_WHY), severity=ERROR, since="0.1")
def target_not_live(volume: Prim, facts: Facts) -> Problems:
    for binding, target in facts.volumes.bindings(volume).with_target(*_WHY):
        what, advice = _WHY[target.state]
        below = "" if target.blamed_path == target.shown else f" below <{target.blamed_path}>"
        yield Problem(
            f"'field:{binding.name}' targets <{target.shown}>{below}, which is {what}",
            at=binding.property,
            suggestion=advice.format(target.blamed_path),
            absent=[lacking(volume, binding.property.GetName())] if target.state is TargetState.OVER else (),
        )
