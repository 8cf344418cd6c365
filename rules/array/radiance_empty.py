"""ARR017: particles without coefficients are all of the same grey."""

from usdvol_lint.rule import WARNING, Facts, Prim, Problem, Problems, lacks, rule


@rule("ARR017", on="ParticleField", severity=WARNING, since="0.1")
def radiance_empty(particles: Prim, facts: Facts) -> Problems:
    arrays = facts.particles.arrays(particles)
    if not arrays.are_colourless or facts.particles.material_is_bound(particles):
        return
    name = "radiance:sphericalHarmonicsCoefficients"
    if facts.particles.is_told_as_misspelt(particles, name) or facts.layers.may_lack_values(particles, name):
        return
    has_colour = particles.GetAttribute("primvars:displayColor").HasAuthoredValue()
    yield Problem(
        "no spherical harmonics coefficients at any time, so every particle is mid-grey"
        + (": 'primvars:displayColor' is not read" if has_colour else ""),
        at=arrays.coefficients.attribute if arrays.coefficients else particles,
        suggestion="author degree 0 and for each colour c the coefficient (c - 0.5) / 0.28209479"
        if has_colour
        else "author radiance:sphericalHarmonicsCoefficients and the degree that fits",
        absent=[lacks(particles, name)],
    )
