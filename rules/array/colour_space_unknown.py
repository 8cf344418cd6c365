"""ARR016: a colour space that USD does not know by name, or does not read, is none to USD."""

from usdvol_lint.rule import APIS, WARNING, Facts, Prim, Problem, Problems, quoted, rule


@rule("ARR016", on="ParticleField", severity=WARNING, since="0.1")
def colour_space_unknown(particles: Prim, facts: Facts) -> Problems:
    space = facts.particles.colour_space(particles)
    if not space or (space.is_known and space.is_applied):
        return
    advice = []
    if not space.is_applied:
        advice.append("apply ColorSpaceAPI, if this is the space that the colours are in")
    if space.unapplied:
        advice.append(f"apply {space.unapplied}, which defines {quoted(space.name)}")
    elif space.similar:
        advice.append(f"did you mean {quoted(space.similar)}?")
    elif not space.is_known:
        advice.append("name one that USD has, such as 'lin_rec709_scene', or define it with ColorSpaceDefinitionAPI")
    yield Problem(
        f"USD knows no colour space {quoted(space.name)}"
        if space.is_applied
        else f"USD does not read the colour space {quoted(space.name)}: ColorSpaceAPI is not applied"
        + ("" if space.is_known else ", nor does it know that name"),
        at=space.attribute,
        of="colorSpace",
        against=[] if space.is_applied else [(particles, (APIS, "ColorSpaceAPI"))],
        suggestion="; ".join(advice),
    )
