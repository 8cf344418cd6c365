"""PRT004: a base API only marks what another API must provide."""

from usdvol_lint.rule import APIS, WARNING, Facts, Prim, Problem, Problems, lacks, rule
from usdvol_lint.schema import API_PROVIDERS, RADIANCE_BASE


@rule("PRT004", on="ParticleField", severity=WARNING, since="0.1")
def base_api_alone(particles: Prim, facts: Facts) -> Problems:
    apis = facts.particles.apis(particles)
    for base, providers in API_PROVIDERS.items() if apis.built_in_type and not apis.third_party else ():
        is_bound = base == RADIANCE_BASE and facts.particles.material_is_bound(particles)
        if is_bound or base not in apis.applied or apis.providers(base) or any(map(apis.has, providers)):
            continue
        yield Problem(
            f"{base!r} is applied, but nothing that provides its data",
            at=particles,
            of=(APIS, base),
            absent=[lacks(particles, *words)] if (words := apis.absent(*providers)) else (),
            suggestion=f"apply {' or '.join(providers)} in its place",
        )
