"""PRT005: a particle field has one kernel and one radiance."""

from usdvol_lint.rule import APIS, WARNING, Facts, Prim, Problem, Problems, rule
from usdvol_lint.schema import KERNEL_BASE, RADIANCE_BASE


@rule("PRT005", on="ParticleField", severity=WARNING, since="0.1")
def several_kernels(particles: Prim, facts: Facts) -> Problems:
    for base, what in ((KERNEL_BASE, "kernel"), (RADIANCE_BASE, "radiance")):
        providers = facts.particles.apis(particles).providers(base)
        if len(providers) > 1:
            yield Problem(
                f"{len(providers)} applied APIs provide the {what}, one should: " + ", ".join(map(repr, providers)),
                at=particles,
                against=[(particles, (APIS, provider)) for provider in providers],
                subject=what,
                suggestion="keep one; what a prim type has built in can't be taken away, so use "
                "the type ParticleField to choose another",
            )
