"""PRT006: an API whose name USD does not know is as good as not applied."""

from usdvol_lint.rule import ERROR, WARNING, Facts, Prim, Problem, Problems, rule
from usdvol_lint.schema import KERNEL_BASE, POSITION_BASE, RADIANCE_BASE

_BASES = {POSITION_BASE: "positions", KERNEL_BASE: "a kernel", RADIANCE_BASE: "radiance"}


@rule("PRT006", on="ParticleField", severity=ERROR, since="0.1")
def unknown_api(particles: Prim, facts: Facts) -> Problems:
    apis = facts.particles.apis(particles)
    if not apis.misspelt or facts.prims.encoding(particles):
        return
    lost = [base for base in _BASES if apis.is_lost(base)]
    is_bound = lost == [RADIANCE_BASE] and facts.particles.material_is_bound(particles)
    missing = " or ".join(_BASES[base] for base in lost)
    consequence = f", so nothing gives these splats {missing}" if lost else ""
    yield Problem(
        f"USD knows no API {', '.join(map(repr, apis.misspelt))}{consequence}",
        at=particles,
        severity=None if lost and not apis.third_party and not is_bound else WARNING,
        suggestion="write " + ", ".join(f"{meant!r} for {name!r}" for name, meant in apis.misspelt.items()),
    )
