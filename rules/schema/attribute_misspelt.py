"""SCH004: an attribute whose name is not quite one of the schema's is read by nobody."""

from usdvol_lint.rule import WARNING, Facts, Prim, Prims, Problem, Problems, When, rule


@rule(
    "SCH004",
    on=("Volume", "VolumeFieldBase", "ParticleField"),
    when=When(Prims.authored, lambda authored: bool(authored.misspellings)),
    severity=WARNING,
    since="0.1",
)
def attribute_misspelt(prim: Prim, facts: Facts) -> Problems:
    for attribute, meant, overridden in facts.prims.misspelt(prim):
        if facts.prims.encoding(prim):
            return
        yield Problem(
            f"{prim.GetTypeName()} has no attribute {attribute.GetName()!r}"
            + (f", so {meant!r} keeps the value of a weaker layer" if overridden else ""),
            at=attribute,
            suggestion=f"did you mean {meant!r}?",
        )
