"""PRT008: a ParticleField with the APIs of a Gaussian splat is one by another name."""

from usdvol_lint.rule import APIS, INFO, Facts, Prim, Problem, Problems, rule
from usdvol_lint.schema import API_INCLUDES, BUILT_IN_APIS, PARTICLE_FIELD, expand_apis

_SPLAT = "ParticleField3DGaussianSplat"
_APIS = frozenset(expand_apis(BUILT_IN_APIS[_SPLAT]))


@rule("PRT008", on=PARTICLE_FIELD, severity=INFO, since="0.1")
def splat_by_parts(particles: Prim, facts: Facts) -> Problems:
    apis = facts.particles.apis(particles)
    is_splat = particles.GetTypeName() == PARTICLE_FIELD and API_INCLUDES.keys() & apis.applied == _APIS
    if is_splat and not apis.misspelt and not apis.third_party and not facts.layers.may_lack(particles):
        yield Problem(
            f"a ParticleField with exactly the {len(BUILT_IN_APIS[_SPLAT])} APIs that {_SPLAT} has built in",
            at=particles,
            against=[(particles, (APIS, api)) for api in BUILT_IN_APIS[_SPLAT]],
            suggestion=f"use the type {_SPLAT}, and do without the list of APIs",
        )
