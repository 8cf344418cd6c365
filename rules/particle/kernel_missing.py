"""PRT002: a particle field must say what shape its particles have."""

from usdvol_lint.rule import ERROR, WARNING, Facts, Prim, Problem, Problems, lacks, rule
from usdvol_lint.schema import KERNEL_BASE


@rule("PRT002", on="ParticleField", severity=ERROR, since="0.1")
def kernel_missing(particles: Prim, facts: Facts) -> Problems:
    apis = facts.particles.apis(particles)
    if KERNEL_BASE not in apis.applied and not facts.particles.is_told_elsewhere(particles, KERNEL_BASE):
        yield Problem(
            f"nothing gives these splats a kernel, their shape: no API schema for one is applied{apis.doubt}",
            at=particles,
            absent=[lacks(particles, word) for word in apis.absent(KERNEL_BASE)],
            severity=WARNING if apis.third_party else None,
            suggestion=apis.remedy(
                KERNEL_BASE,
                "apply ParticleFieldKernelGaussianEllipsoidAPI for splats with depth, "
                "ParticleFieldKernelGaussianSurfletAPI or ParticleFieldKernelConstantSurfletAPI for flat ones",
            ),
        )
