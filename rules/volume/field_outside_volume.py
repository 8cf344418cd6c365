"""VOL011: a field that one Volume alone uses should lie below it."""

from usdvol_lint.rule import INFO, BindingMark, Facts, Prim, Problem, Problems, bindings, rule


@rule("VOL011", on="Volume", when=bindings(BindingMark.OUTSIDE), severity=INFO, since="0.1", default=False)
def field_outside_volume(volume: Prim, facts: Facts) -> Problems:
    for binding, target in facts.volumes.bindings(volume).outside(volume):
        if not facts.volumes.is_shared(volume, target.prim):
            yield Problem(
                f"'field:{binding.name}' binds the field <{target.shown}>, which no other Volume "
                "uses and which does not lie below this one",
                at=binding.property,
                against=[target.prim],
                suggestion=f"move the field below <{facts.prims.shown_path(volume)}>",
            )
