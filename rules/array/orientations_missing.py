"""ARR021: flat particles without orientations all face the same way."""

from usdvol_lint.rule import APIS, INFO, Facts, Prim, Problem, Problems, quoted, rule
from usdvol_lint.schema import API_ATTRIBUTES

_FLAT = frozenset({"ParticleFieldKernelGaussianSurfletAPI", "ParticleFieldKernelConstantSurfletAPI"})
_API = "ParticleFieldOrientationAttributeAPI"


@rule("ARR021", on="ParticleField", severity=INFO, since="0.1")
def orientations_missing(particles: Prim, facts: Facts) -> Problems:
    apis, arrays = facts.particles.apis(particles), facts.particles.arrays(particles)
    kernels = apis.providers("ParticleFieldKernelBaseAPI")
    if len(kernels) != 1 or kernels[0] not in _FLAT or apis.third_party or not arrays.most_particles:
        return
    if not arrays.lack("orientations") or facts.layers.may_lack_values(particles, "orientations"):
        return
    if facts.particles.is_told_as_misspelt(particles, "orientations"):
        return
    are_authored = any(particles.GetAttribute(name).HasAuthoredValue() for name in API_ATTRIBUTES[_API])
    if are_authored and _API not in apis.applied and (apis.has(_API) or facts.tells("PRT007")):
        return
    yield Problem(
        f"no orientations for the flat kernel {quoted(kernels[0])}, so all particles face along z",
        at=particles,
        against=[(particles, (APIS, kernels[0]))],
        suggestion=("" if apis.has(_API) else f"apply {_API} and ")
        + "author orientations that turn z to the normals of the surface",
    )
