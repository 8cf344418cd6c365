"""ARR019: exp and the sigmoid are applied once."""

from usdvol_lint.rule import WARNING, Facts, Prim, Problem, Problems, rule

_FEW = 32
_SIGMOID_OF_ONE = 0.7310586
_HIGHEST_SIGMOID = 0.7311
_TOLERANCE = 2e-4
"""Half the distance of halfs next to that."""


@rule("ARR019", on="ParticleField", severity=WARNING, since="0.1")
def step_taken_twice(particles: Prim, facts: Facts) -> Problems:
    scales = facts.particles.scales(particles)
    if scales and scales.array.most >= _FEW and scales.are_spread_as_exp:
        yield Problem(
            f"scales from {scales.low:.6g} to {scales.high:.6g}, where particles lie {scales.spacing:.3g} apart, "
            "look like the exp of sizes, not of their logarithms",
            at=scales.array.attribute,
            suggestion="apply exp once: the values had been through it before the export",
        )
    opacities = facts.particles.arrays(particles).finite("opacities")
    if opacities and opacities.most >= _FEW and opacities.span and _are_sigmoids_of_opacities(*opacities.span):
        low, high = opacities.span
        yield Problem(
            f"opacities from {low:.6g} to {high:.6g} look like the sigmoid of opacities, not of logits",
            at=opacities.attribute,
            suggestion="apply the sigmoid once: the values had been through it before the export",
        )


def _are_sigmoids_of_opacities(low: float, high: float) -> bool:
    are_squeezed = 0.5 <= low < 0.53 and 0.72 < high <= _HIGHEST_SIGMOID
    are_alike = all(abs(end - _SIGMOID_OF_ONE) <= _TOLERANCE for end in (low, high))
    return are_squeezed or are_alike
