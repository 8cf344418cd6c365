"""ARR004: each particle has as many spherical harmonics coefficients as the degree says."""

from usdvol_lint.rule import ERROR, WARNING, Facts, Prim, Problem, Problems, lacks, rule

_LEAVE_OUT = "leave the same particles out of the coefficients; cut the end off only if it is spare"


@rule("ARR004", on="ParticleField", severity=ERROR, since="0.1")
def sh_count_differs(particles: Prim, facts: Facts) -> Problems:
    arrays = facts.particles.arrays(particles)
    degree, each, fitting = arrays.degree, arrays.degree.coefficients, arrays.fitting_degree
    is_lost = facts.particles.is_told_as_misspelt(particles, degree.attribute.GetName()) and not arrays.suit_degree
    if not each or is_lost:  # ARR005 or SCH004 says it
        return
    against = [degree.attribute, *([arrays.positions.attribute] if arrays.positions else ())]
    absent = [lacks(particles, name) for name in arrays.absent_degree]
    fits = f"author radiance:sphericalHarmonicsDegree = {fitting}, which fits"
    again = f"export all of degree {degree.value} again, or author degree {fitting}" if degree.is_authored else fits
    more = f"author {each:,} coefficient{'s' * (each > 1)} for each position"
    for array in arrays.used("coefficients"):
        authored = "" if degree.is_authored else ", what USD falls back to,"
        short, long = arrays.too_short(array, each), arrays.too_long(array, each)
        takes = f"degree {degree.value}{authored} takes {each:,}{' for each' * (fitting is None)}"
        remedy = facts.particles.misfitting_default(particles, array) if short or long else None
        if short and not _is_told("ARR002", facts, particles, are_long=False):
            yield Problem(
                f"{short.shares}; {takes}",
                at=short,
                absent=absent,
                against=against,
                suggestion=remedy or (more if fitting is None else again),
            )
        if long and not _is_told("ARR003", facts, particles, are_long=True):
            shift = ": if particles were left out of the others, every later one has the colours of another"
            yield Problem(
                f"{long.shares}; {takes}{shift if fitting is None else ''}",
                at=long,
                absent=absent,
                against=against,
                severity=None if arrays.others_fit(array) or fitting is not None else WARNING,
                suggestion=remedy or (_LEAVE_OUT if fitting is None else fits),
            )


def _is_told(code: str, facts: Facts, prim: Prim, *, are_long: bool) -> bool:
    """Whether another rule names the coefficients too, among other arrays."""
    return facts.tells(code) and any(it.join_coefficients for it in facts.particles.misfits(prim, are_long=are_long))
