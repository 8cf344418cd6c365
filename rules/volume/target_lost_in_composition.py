"""VOL007: the target of a field relationship must survive composition."""

from usdvol_lint.rule import ERROR, Emptiness, Facts, Prim, Problem, Problems, bindings, rule


@rule("VOL007", on="Volume", when=bindings(Emptiness.LOST), severity=ERROR, since="0.1")
def target_lost_in_composition(volume: Prim, facts: Facts) -> Problems:
    for binding in facts.volumes.bindings(volume).relationships:
        if binding.emptiness is Emptiness.LOST:
            spec = binding.lost[0]
            target = spec.targetPathList.GetAddedOrExplicitItems()[0]
            yield Problem(
                f"'field:{binding.name}' loses its target in composition: <{target}> lies outside "
                f"the prim that is referenced in {spec.layer.GetDisplayName()!r}",
                at=binding.property,
                spec=binding.losing_arc,
                suggestion="move the field below the prim that is referenced, or reference a prim that holds both",
            )
