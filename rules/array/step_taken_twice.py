"""ARR019: exp and the sigmoid are applied once, and colours become coefficients."""

from usdvol_lint.rule import INFO, WARNING, Facts, ParticleArray, Prim, Problem, Problems, rule

_FEW = 32
_MANY = 1000
_SIGMOID_OF_ONE = 0.7310586
_HIGHEST_SIGMOID = 0.7311
_TOLERANCE = 2e-4
"""Half the distance of halfs next to that."""


@rule("ARR019", on="ParticleField", severity=WARNING, since="0.1")
def step_taken_twice(particles: Prim, facts: Facts) -> Problems:
    arrays = facts.particles.arrays(particles)
    for array in arrays.used("scales", "opacities", "coefficients"):
        if array.has_nan or array.has_infinity:
            continue  # ARR007 says it
        if array.noun == "scales":
            yield from _exp_of_exp(array, facts, particles) if array.most >= _FEW else ()
            yield from _large(array, facts, particles) if array.most >= _MANY else ()
        elif array.noun == "opacities":
            yield from _sigmoid_of_sigmoid(array) if array.most >= _FEW else ()
        else:
            yield from _colours(array, facts, arrays.most_particles)


def _exp_of_exp(array: ParticleArray, facts: Facts, particles: Prim) -> Problems:
    """A scan in millimetres has sizes above 1 too, but its particles lie about as far apart."""
    if not array.low or not array.high or min(array.low) < 1:
        return
    low, high, mean = min(array.low), max(array.high), facts.particles.mean(array)
    spacing = facts.particles.spacing(particles)
    if mean <= 1.5 and mean > 2 * spacing and high - 1 > 3 * (mean - 1):
        yield Problem(
            f"scales from {low:.6g} to {high:.6g}, where particles lie {spacing:.3g} apart, look like the exp "
            "of sizes, not of their logarithms",
            at=array.attribute,
            suggestion="apply exp once: the values had been through it before the export",
        )


def _large(array: ParticleArray, facts: Facts, particles: Prim) -> Problems:
    side = facts.particles.longest_side(particles)
    if not array.low or not array.high or min(array.low) < 0 or not 0 < side < 10 * max(array.high):
        return
    if any(_exp_of_exp(array, facts, particles)):
        return
    mean = facts.particles.mean(array)
    if mean > side / 10:
        yield Problem(
            f"the mean of all scales, {mean:.3g}, is more than a tenth of the extent, {side:.6g}",
            at=array.attribute,
            severity=INFO,
            suggestion="see whether scales and positions have the same unit, and exp was applied once",
        )


def _sigmoid_of_sigmoid(array: ParticleArray) -> Problems:
    if not array.low or not array.high:
        return
    (low,), (high,) = array.low, array.high
    are_squeezed = 0.5 <= low < 0.53 and 0.72 < high <= _HIGHEST_SIGMOID
    are_alike = all(abs(end - _SIGMOID_OF_ONE) <= _TOLERANCE for end in (low, high))
    if are_squeezed or are_alike:
        yield Problem(
            f"opacities from {low:.6g} to {high:.6g} look like the sigmoid of opacities, not of logits",
            at=array.attribute,
            suggestion="apply the sigmoid once: the values had been through it before the export",
        )


def _colours(array: ParticleArray, facts: Facts, particles: int) -> Problems:
    found = facts.particles.range_within(array, 0, 255)
    if not found:
        return
    low, high = found
    if max(high) > 64 and facts.particles.are_whole(array):
        yield Problem(
            f"the coefficients are whole numbers from {min(low):g} to {max(high):g}, as the bytes of colours are",
            at=array.attribute,
            suggestion="author degree 0 and for each byte b the coefficient (b / 255 - 0.5) / 0.28209479",
        )
    elif particles >= _MANY and low != high and 0.5 < max(high) <= 1:
        yield Problem(
            f"all coefficients lie from {min(low):.6g} to {max(high):.6g}, as colours do",
            at=array.attribute,
            severity=INFO,
            suggestion="if they are colours, author for each c the coefficient (c - 0.5) / 0.28209479",
        )
