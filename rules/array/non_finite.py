"""ARR007: no array may hold NaN or infinity."""

from usdvol_lint.rule import ERROR, Facts, Prim, Problem, Problems, rule

_FEW = 0.1
_LOGITS = "these look like logits: the sigmoid, 1 / (1 + exp(-x)), before the export makes 1 of inf and 0 of -inf"
_LOGARITHMS = "these look like logarithms: exp(x) before the export makes 0 of -inf; look for what made any inf"
_OPACITIES = "author 1 for inf, the opaque end, and 0 for -inf"
_NAN = "; particles with NaN have to be exported again, or left out"


@rule("ARR007", on="ParticleField", severity=ERROR, since="0.1")
def non_finite(particles: Prim, facts: Facts) -> Problems:
    for spoilt in facts.particles.arrays(particles).non_finite():
        array, found = spoilt.array, spoilt.found
        raw = facts.particles.raw_numbers(array)
        meaning = _meaning_of_infinity(array.noun, bool(raw)) if array.has_infinity else ""
        overflows = array.is_half and array.has_infinity and not meaning
        kinds = ("NaN", array.has_nan), ("infinity", array.has_infinity)
        what = " or ".join(name for name, is_there in kinds if is_there)
        yield Problem(
            f"{found.amount_that(*_verbs(array.noun, what))}"
            f"{', beyond the 65,504 that half goes up to' * overflows}, {found.first}{spoilt.shared}"
            f"{', so the extent is not finite either' * array.spoils(facts.prims.extents(particles))}"
            + (f", and {raw.words}" if raw else ""),
            at=raw.at if raw else found,
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


def _meaning_of_infinity(noun: str, is_raw: bool) -> str:
    if noun == "opacities":
        return _LOGITS if is_raw else _OPACITIES
    return _LOGARITHMS if is_raw else ""
