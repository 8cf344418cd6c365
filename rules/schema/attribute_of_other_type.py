"""SCH016: an attribute of UsdVol's on a prim whose type lacks it is read by nobody."""

from operator import attrgetter

from usdvol_lint.rule import INFO, OURS, TYPE, VALUED_NAME, Facts, Prim, Prims, Problem, Problems, When, rule
from usdvol_lint.schema import DECLARED_BY


@rule(
    "SCH016",
    on=OURS,
    when=When(Prims.authored, lambda authored: not authored.undeclared.isdisjoint(DECLARED_BY)),
    severity=INFO,
    since="0.1",
)
def attribute_of_other_type(prim: Prim, facts: Facts) -> Problems:
    if facts.layers.hides_ours(prim):
        return
    undeclared = facts.prims.authored(prim).undeclared
    misspelt = {slip.attribute.GetName() for slip in facts.prims.misspelt(prim)}
    for name in sorted(undeclared.intersection(DECLARED_BY) - misspelt):
        if "OpenVDBAsset" in DECLARED_BY[name] and _is_to_be_openvdb(prim, facts):
            continue
        attribute = prim.GetAttribute(name)
        if not attribute or not attribute.HasAuthoredValue() or facts.prims.encoding(prim):
            continue
        yield Problem(
            f"{name!r} is an attribute of {' and '.join(DECLARED_BY[name])}, and this is a {prim.GetTypeName()}",
            at=attribute,
            of=VALUED_NAME,
            against=[(prim, TYPE)],
            suggestion="remove it, or use a type that has it",
        )


def _is_to_be_openvdb(prim: Prim, facts: Facts) -> bool:
    """Whether AST006 tells of a field that its type should be that of OpenVDB."""
    is_field = facts.tells("AST006") and facts.prims.is_a(prim, "FieldAsset")
    return is_field and bool(facts.grids.contents(prim).grouped(attrgetter("swapped_format")))
