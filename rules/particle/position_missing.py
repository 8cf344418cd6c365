"""PRT001: a particle field must say where its particles are."""

from usdvol_lint.rule import ERROR, WARNING, Facts, Prim, Problem, Problems, lacks, rule
from usdvol_lint.schema import POSITION_BASE


@rule("PRT001", on="ParticleField", severity=ERROR, since="0.1")
def position_missing(particles: Prim, facts: Facts) -> Problems:
    apis = facts.particles.apis(particles)
    if POSITION_BASE not in apis.applied and not facts.particles.is_told_elsewhere(particles, POSITION_BASE):
        yield Problem(
            "nothing gives these splats positions: the API schema for positions is not applied"
            f"{apis.unread(particles, POSITION_BASE)}{apis.doubt}",
            at=particles,
            absent=[lacks(particles, word) for word in apis.absent(POSITION_BASE)],
            severity=WARNING if apis.third_party else None,
            suggestion=apis.remedy(
                POSITION_BASE,
                "apply ParticleFieldPositionAttributeAPI, or use ParticleField3DGaussianSplat, which has it built in",
            ),
        )
