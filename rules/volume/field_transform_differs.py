"""VOL015: a field outside its Volume should have the Volume's transform."""

from usdvol_lint.rule import INFO, BindingMark, Facts, Prim, Problem, Problems, bindings, rule


@rule("VOL015", on="Volume", when=bindings(BindingMark.OUTSIDE), severity=INFO, since="0.1")
def field_transform_differs(volume: Prim, facts: Facts) -> Problems:
    for binding, target in facts.volumes.bindings(volume).outside(volume):
        displacement = facts.volumes.displacement(volume, target.prim)
        if displacement:
            yield Problem(
                f"'field:{binding.name}' binds the field <{target.shown}>, which does not move "
                f"with the Volume: its space is {displacement.words} in relation to the Volume's",
                at=binding.property,
                against=[target.prim, *displacement.against],
                times=displacement.times,
                suggestion="move the field below the Volume, or give both the same transform",
            )
