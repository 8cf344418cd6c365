"""SCH006: a uniform attribute has one value, and time samples are no such thing."""

from usdvol_lint.rule import OURS, WARNING, Facts, Prim, Prims, Problem, Problems, When, rule

_UNIFORM = When(Prims.authored, lambda authored: bool(authored.uniform))


@rule("SCH006", on=OURS, when=_UNIFORM, severity=WARNING, since="0.1")
def uniform_attribute_animated(prim: Prim, facts: Facts) -> Problems:
    for name in facts.prims.authored(prim).uniform:
        values = facts.prims.values(prim, name)
        if values.total:
            samples = "a time sample" if values.total == 1 else f"{values.total} time samples"
            yield Problem(
                f"{name!r} is uniform, but has {samples}",
                at=values.attribute,
                times=values.times,
                suggestion="author one value, as the default",
            )
