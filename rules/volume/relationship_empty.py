"""VOL003: a field relationship must have a target."""

from usdvol_lint.rule import INFO, WARNING, Emptiness, Facts, Prim, Problem, Problems, bindings, lacks, rule


@rule(
    "VOL003",
    on="Volume",
    when=bindings(Emptiness.UNAUTHORED, Emptiness.BLOCKED, Emptiness.DELETED, Emptiness.CIRCULAR),
    severity=WARNING,
    since="0.1",
)
def relationship_empty(volume: Prim, facts: Facts) -> Problems:
    for binding in facts.volumes.bindings(volume).relationships:
        meant = facts.volumes.intended_field(binding) if binding.emptiness else None
        if binding.emptiness is Emptiness.UNAUTHORED:
            behind = f" behind <{binding.forwards_to}>" if binding.forwards_to else ""
            yield Problem(
                f"'field:{binding.name}' has no target{behind}",
                at=binding.property,
                suggestion=f"did you mean <{meant}>?" if meant else "name a field, or remove it",
                absent=[lacks(volume, binding.property.GetName())],
            )
        elif binding.emptiness is Emptiness.CIRCULAR:
            yield Problem(
                f"'field:{binding.name}' forwards to <{binding.forwards_to}>, which leads round in a circle",
                at=binding.property,
                suggestion=f"did you mean <{meant}>?" if meant else "target a field",
            )
        elif binding.emptiness in (Emptiness.BLOCKED, Emptiness.DELETED):
            yield Problem(
                f"'field:{binding.name}' has no target, since a stronger opinion takes it away"
                if binding.emptiness is Emptiness.DELETED
                else f"'field:{binding.name}' is authored to have no target",
                at=binding.property,
                severity=INFO,
                suggestion="leave it, if the Volume is to go without this field; if not, target one",
            )
