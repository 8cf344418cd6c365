"""ARR016: a colour space that USD does not know by name is none to USD."""

from usdvol_lint.rule import WARNING, Facts, Prim, Problem, Problems, quoted, rule


@rule("ARR016", on="ParticleField", severity=WARNING, since="0.1")
def colour_space_unknown(particles: Prim, facts: Facts) -> Problems:
    space = facts.particles.colour_space(particles)
    if space and not space.is_known:
        yield Problem(
            f"USD knows no colour space {quoted(space.name)}",
            at=space.attribute,
            suggestion=f"did you mean {quoted(space.similar)}?"
            if space.similar
            else "name one of GfColorSpaceNames, or define it with ColorSpaceDefinitionAPI",
        )
