"""SCH004: an attribute whose name is not quite one of the schema's is read by nobody."""

from typing import Any

from usdvol_lint.rule import ERROR, OURS, VALUED_NAME, WARNING, Facts, Prim, Prims, Problem, Problems, When, lacks, rule

_LOSSES = {
    "filePath": "so no file is found",
    "fieldName": "so the field names no grid",
    "fieldDataType": "so the field says no type of data",
    "extent": "so USD takes the bounds for empty",
    "positions": "so there are no particles",
    "radiance:sphericalHarmonicsCoefficients": "so every particle is mid-grey",
    "radiance:sphericalHarmonicsDegree": "and the coefficients do not fit the degree that USD takes",
}
_GRAVE = ("filePath", "positions", "radiance:sphericalHarmonicsDegree")
_SLIPS = When(Prims.authored, lambda authored: bool(authored.misspellings))


@rule("SCH004", on=OURS, when=_SLIPS, severity=ERROR, since="0.1")
def attribute_misspelt(prim: Prim, facts: Facts) -> Problems:
    for slip in () if facts.prims.encoding(prim) else facts.prims.misspelt(prim):
        meant, loss = slip.intended, _LOSSES[slip.pair] if _is_lost(slip, prim, facts) else ""
        kept = f", so {meant!r} keeps the value of a weaker layer" if slip.overridden else ""
        yield Problem(
            f"{prim.GetTypeName()} has no attribute {slip.shown}{kept}" + f", {loss}" * bool(loss),
            at=slip.attribute,
            of=VALUED_NAME,
            severity=None if slip.hiding or (loss and slip.pair in _GRAVE) else WARNING,
            suggestion=f"did you mean {meant!r}?",
            absent=[lacks(prim, slip.pair)] if loss else (),
        )


def _is_lost(slip: Any, prim: Prim, facts: Facts) -> bool:
    """Whether nothing else says what an attribute was meant to say, as far as that matters."""
    if slip.pair not in _LOSSES or facts.layers.may_lack_values(prim, slip.pair):
        return False
    if slip.pair == "radiance:sphericalHarmonicsDegree":
        return not facts.particles.arrays(prim).suit_degree
    if slip.overridden or slip.pair in ("fieldName", "fieldDataType"):
        return not slip.overridden
    if slip.pair == "filePath":
        return not facts.files.paths(prim).is_only_declared
    if slip.pair == "extent":
        return prim in facts.prims.without_extent
    if slip.pair == "positions":
        return facts.particles.arrays(prim).lack_positions and slip.has_elements
    return facts.particles.arrays(prim).are_colourless and not facts.particles.material_is_bound(prim)
