"""ARR007: no array may hold NaN or infinity."""

from usdvol_lint.rule import ERROR, Facts, Prim, Problem, Problems, rule


@rule("ARR007", on="ParticleField", severity=ERROR, since="0.1")
def non_finite(particles: Prim, facts: Facts) -> Problems:
    for array in facts.particles.arrays(particles).used():
        found = array.non_finite()
        if not found:
            continue
        overflows = array.is_half and array.has_infinity
        kinds = ("NaN", array.has_nan), ("infinity", array.has_infinity)
        yield Problem(
            f"{' and '.join(name for name, is_there in kinds if is_there)} in {found.amount}"
            f"{', beyond the 65,504 that half goes up to' if overflows else ''}, {found.first}",
            at=found,
            suggestion=f"author the float array {array.float_name!r}, or smaller values"
            if overflows
            else "remove these particles, in all arrays, before the export",
        )
