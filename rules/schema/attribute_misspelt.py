"""SCH004: an attribute whose name is not quite one of the schema's is read by nobody."""

from typing import Any

from usdvol_lint.rule import ERROR, OURS, WARNING, Facts, Prim, Prims, Problem, Problems, When, rule


@rule(
    "SCH004",
    on=OURS,
    when=When(Prims.authored, lambda authored: bool(authored.misspellings)),
    severity=ERROR,
    since="0.1",
)
def attribute_misspelt(prim: Prim, facts: Facts) -> Problems:
    for attribute, meant, overridden in facts.prims.misspelt(prim):
        if facts.prims.encoding(prim):
            return
        is_fatal = meant.startswith("positions") and _holds_the_particles(attribute, prim, facts)
        yield Problem(
            f"{prim.GetTypeName()} has no attribute {attribute.GetName()!r}"
            + (f", so {meant!r} keeps the value of a weaker layer" if overridden else "")
            + (f", and without {meant!r} no particles" if is_fatal else ""),
            at=attribute,
            severity=None if is_fatal else WARNING,
            suggestion=f"did you mean {meant!r}?",
        )


def _holds_the_particles(attribute: Any, particles: Prim, facts: Facts) -> bool:
    """Whether a particle field has no particles, and this array has elements."""
    if not facts.particles.arrays(particles).lack_positions:
        return False
    values = facts.prims.values(particles, attribute.GetName())
    has_elements = attribute.GetTypeName().isArray and any(map(len, values))
    return has_elements and not facts.layers.may_lack_values(particles)
