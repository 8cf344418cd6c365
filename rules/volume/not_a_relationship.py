"""VOL006: a field must be bound by a relationship in the `field:` namespace."""

from usdvol_lint.rule import ERROR, NAME, WARNING, BindingMark, Facts, Prim, Problem, Problems, bindings, rule


@rule("VOL006", on="Volume", when=bindings(BindingMark.ATTRIBUTE, BindingMark.UNDECLARED), severity=ERROR, since="0.1")
def not_a_relationship(volume: Prim, facts: Facts) -> Problems:
    fields = facts.volumes.bindings(volume)
    for binding in fields.bindings:
        if not binding.is_relationship:
            yield Problem(
                f"'field:{binding.name}' is an attribute, not a relationship",
                at=binding.property,
                of=NAME,
                suggestion=f"write 'rel field:{binding.name} = <path of the field prim>'",
            )
    for relationship in fields.undeclared:
        name = relationship.GetName()
        wanted = "<name>" if name == "field" else relationship.GetBaseName()
        yield Problem(
            f"the relationship {name!r} is outside the 'field:' namespace, so it binds no field",
            at=relationship,
            of=NAME,
            severity=WARNING,
            suggestion=f"name it 'field:{wanted}'",
        )
