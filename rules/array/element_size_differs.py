"""ARR015: an `elementSize` that is not what the degree says misleads who believes it."""

from usdvol_lint.rule import INFO, Facts, Prim, Problem, Problems, lacks, rule


@rule("ARR015", on="ParticleField", severity=INFO, since="0.1")
def element_size_differs(particles: Prim, facts: Facts) -> Problems:
    arrays = facts.particles.arrays(particles)
    degree, each, fitting = arrays.degree, arrays.degree.coefficients, arrays.fitting_degree
    is_lost = facts.particles.is_told_as_misspelt(particles, degree.attribute.GetName())
    if each is None or is_lost or (fitting not in (None, degree.value) and facts.tells("ARR004")):
        return
    for array in arrays.authored("coefficients"):
        size = array.attribute.GetMetadata("elementSize")
        if array.attribute.HasAuthoredMetadata("elementSize") and size != each:
            yield Problem(
                f"elementSize {size}, and degree {degree.value} takes {each:,} coefficient{'s' * (each != 1)}",
                at=array.attribute,
                of="elementSize",
                absent=[] if degree.is_authored else [lacks(particles, degree.attribute.GetName())],
                against=[degree.attribute],
                suggestion=f"author elementSize = {each}, or leave it out",
            )
