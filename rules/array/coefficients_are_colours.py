"""ARR023: colours become coefficients before they are authored as such."""

from usdvol_lint.rule import INFO, WARNING, Facts, Prim, Problem, Problems, rule

_MANY = 1000


@rule("ARR023", on="ParticleField", severity=WARNING, since="0.1")
def coefficients_are_colours(particles: Prim, facts: Facts) -> Problems:
    arrays = facts.particles.arrays(particles)
    for array in arrays.used("coefficients"):
        found = facts.particles.range_within(array, 0, 255)
        if not found:
            continue
        low, high = found
        if max(high) > 64 and facts.particles.are_whole(array):
            yield Problem(
                f"the coefficients are whole numbers from {min(low):g} to {max(high):g}, as the bytes of colours are",
                at=array.attribute,
                suggestion="author degree 0 and for each byte b the coefficient (b / 255 - 0.5) / 0.28209479",
            )
        elif arrays.most_particles >= _MANY and low != high and 0.5 < max(high) <= 1:
            yield Problem(
                f"all coefficients lie from {min(low):.6g} to {max(high):.6g}, as colours do",
                at=array.attribute,
                severity=INFO,
                suggestion="if they are colours, author for each c the coefficient (c - 0.5) / 0.28209479",
            )
