"""VOL004: a field relationship must have one target only."""

from usdvol_lint.rule import ERROR, BindingMark, Facts, Prim, Problem, Problems, TargetState, bindings, rule


@rule("VOL004", on="Volume", when=bindings(BindingMark.SEVERAL_TARGETS), severity=ERROR, since="0.1")
def several_targets(volume: Prim, facts: Facts) -> Problems:
    for binding in facts.volumes.bindings(volume).bindings:
        if len(binding.targets) > 1:
            targets = ", ".join(f"<{target.shown}>" for target in binding.targets)
            fields = [each for each in binding.targets if each.state is TargetState.FIELD]
            yield Problem(
                f"'field:{binding.name}' has {len(binding.targets)} targets, {targets}, and USD "
                "binds a field only where there is exactly one",
                at=binding.property,
                suggestion=f"keep <{fields[0].shown}>, the only field among them"
                if len(fields) == 1
                else "keep one, and give each other field a relationship of its own",
            )
