"""ARR025: a default must not hide the animation of particles."""

from usdvol_lint.rule import INFO, WARNING, Facts, Prim, Problem, Problems, layered, rule


@rule("ARR025", on="ParticleField", when=layered(), severity=WARNING, since="0.1")
def default_hides_particles(particles: Prim, facts: Facts) -> Problems:
    if facts.layers.may_lack_values(particles):
        return
    arrays = facts.particles.arrays(particles)
    for array in arrays.used():
        hidden = None if array.total else facts.prims.hidden_animation(array.attribute)
        sizes = [len(value) for value in hidden.values()] if hidden else []
        if not hidden or len(sizes) < 2:
            continue
        if array.most not in sizes and not arrays.fit(array) and facts.tells("ARR002", "ARR003", "ARR004"):
            continue
        are_positions, differs = array is arrays.positions, hidden.differs
        if differs or are_positions:
            yield Problem(
                f"the default of {array.name!r} holds at all times and hides {hidden.words}"
                + ("" if differs else ", which are all alike"),
                at=array.attribute,
                severity=None if differs and are_positions else INFO,
                suggestion="author time samples in its place, or remove it",
            )
