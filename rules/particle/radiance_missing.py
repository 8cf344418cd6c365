"""PRT003: a particle field must say how its particles look."""

from usdvol_lint.rule import ERROR, WARNING, Facts, Prim, Problem, Problems, lacks, rule
from usdvol_lint.schema import RADIANCE_BASE


@rule("PRT003", on="ParticleField", severity=ERROR, since="0.1")
def radiance_missing(particles: Prim, facts: Facts) -> Problems:
    apis = facts.particles.apis(particles)
    if RADIANCE_BASE in apis.applied or facts.particles.is_told_elsewhere(particles, RADIANCE_BASE):
        return
    bound = facts.particles.material_is_bound(particles)
    effect = apis.unread(particles, RADIANCE_BASE) + "; the bound material serves only renderers that prefer it" * bound
    yield Problem(
        f"nothing gives these splats radiance, their colours: no API schema for it is applied{effect}{apis.doubt}",
        at=particles,
        absent=[lacks(particles, word) for word in apis.absent(RADIANCE_BASE)],
        severity=WARNING if bound or apis.third_party else None,
        suggestion=apis.remedy(RADIANCE_BASE, "apply ParticleFieldSphericalHarmonicsAttributeAPI"),
    )
