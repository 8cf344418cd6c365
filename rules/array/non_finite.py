"""ARR007: no array may hold NaN or infinity."""

from usdvol_lint.rule import ERROR, Facts, ParticleArray, Prim, Problem, Problems, rule

_FEW = 0.1
_LOGITS = "these look like logits: the sigmoid, 1 / (1 + exp(-x)), before the export makes 1 of inf and 0 of -inf"
_LOGARITHMS = "these look like logarithms: exp(x) before the export makes 0 of -inf; look for what made any inf"
_OPACITIES = "author 1 for inf, the opaque end, and 0 for -inf"
_NAN = "; particles with NaN have to be exported again, or left out"


@rule("ARR007", on="ParticleField", severity=ERROR, since="0.1")
def non_finite(particles: Prim, facts: Facts) -> Problems:
    for array in facts.particles.arrays(particles).used():
        found = array.non_finite()
        if not found:
            continue
        meaning = _meaning_of_infinity(array, facts)
        overflows = array.is_half and array.has_infinity and not meaning
        kinds = ("NaN", array.has_nan), ("infinity", array.has_infinity)
        what = " or ".join(name for name, is_there in kinds if is_there)
        yield Problem(
            f"{found.amount_that(*_verbs(array.noun, what))}"
            f"{', beyond the 65,504 that half goes up to' * overflows}, {found.first}"
            f"{', so the extent is not finite either' * array.spoils(facts.prims.extents(particles))}",
            at=found,
            suggestion=meaning + _NAN * array.has_nan
            if meaning
            else f"author the float array {array.float_name!r}, or smaller values"
            if overflows
            else "remove these particles, in all arrays, before the export"
            if found.share <= _FEW
            else "find out what made them and export again: too many to leave out",
        )


def _verbs(noun: str, what: str) -> tuple[str, str]:
    if noun != "opacities":
        return f"has {what}", f"have {what}"
    kind = what.replace("infinity", "infinite")
    return f"is {kind}", f"are {kind}"


def _meaning_of_infinity(array: ParticleArray, facts: Facts) -> str:
    if array.noun == "opacities" and array.has_infinity:
        return _LOGITS if facts.particles.are_logits(array, array.outside(-1e-3, 1 + 1e-3)) else _OPACITIES
    are_logarithms = array.noun == "scales" and array.has_infinity
    are_raw = are_logarithms and facts.particles.are_logarithms(array, array.outside(0.0, float("inf")))
    return _LOGARITHMS * are_raw
