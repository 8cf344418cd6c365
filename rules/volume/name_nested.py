"""VOL009: what follows `field:` must be one name, since USD uses only the last part."""

from usdvol_lint.rule import ERROR, NAME, WARNING, BindingMark, Facts, Prim, Problem, Problems, bindings, rule


@rule("VOL009", on="Volume", when=bindings(BindingMark.NESTED), severity=ERROR, since="0.1")
def name_nested(volume: Prim, facts: Facts) -> Problems:
    relationships = [each for each in facts.volumes.bindings(volume).relationships if each.target]
    for binding in facts.volumes.bindings(volume).relationships:
        if ":" not in binding.name:
            continue
        rivals = [each.name for each in relationships if each.key == binding.key]
        rivals = [name for name in rivals if name != binding.name] if binding.target else []
        clash = f" as it does 'field:{rivals[0]}', and drops one of the two" if rivals else " only"
        yield Problem(
            f"USD knows 'field:{binding.name}' as {binding.key!r}{clash}",
            at=binding.property,
            of=NAME,
            severity=ERROR if rivals else WARNING,
            suggestion=f"name it 'field:{binding.name.replace(':', '_')}'",
        )
