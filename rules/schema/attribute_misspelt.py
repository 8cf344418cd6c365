"""SCH004: an attribute whose name is not quite one of the schema's is read by nobody."""

from typing import Any

from usdvol_lint.rule import ERROR, OURS, WARNING, Facts, Prim, Prims, Problem, Problems, When, lacks, rule

_LOSSES = {
    "filePath": "so no file is found",
    "fieldName": "so the field names no grid",
    "fieldDataType": "so the field says no type of data",
    "extent": "so USD takes the bounds for empty",
    "positions": "so there are no particles",
    "radiance:sphericalHarmonicsCoefficients": "so every particle is mid-grey",
}
_SLIPS = When(Prims.authored, lambda authored: bool(authored.misspellings))


@rule("SCH004", on=OURS, when=_SLIPS, severity=ERROR, since="0.1")
def attribute_misspelt(prim: Prim, facts: Facts) -> Problems:
    for slip in () if facts.prims.encoding(prim) else facts.prims.misspelt(prim):
        meant, loss = slip.intended, _loss(slip, prim, facts)
        yield Problem(
            f"{prim.GetTypeName()} has no attribute {slip.shown!r}"
            + (f", only {f'{slip.hiding} {slip.attribute.GetName()}'!r}" if slip.hiding else "")
            + (f", so {meant!r} keeps the value of a weaker layer" if slip.overridden else "")
            + (f", {loss}" if loss else ""),
            at=slip.attribute,
            severity=None if slip.hiding or (loss and slip.pair in ("filePath", "positions")) else WARNING,
            suggestion=f"did you mean {meant!r}?",
            absent=[lacks(prim, slip.pair)] if loss else (),
        )


def _loss(slip: Any, prim: Prim, facts: Facts) -> str:
    """In words what nothing says instead; empty where something else may, or was not meant to."""
    is_open = slip.overridden or slip.pair not in _LOSSES or facts.layers.may_lack_values(prim, slip.pair)
    return "" if is_open or _is_elsewhere(slip, prim, facts) else _LOSSES[slip.pair]


def _is_elsewhere(slip: Any, prim: Prim, facts: Facts) -> bool:
    if slip.pair == "filePath":
        return facts.files.paths(prim).is_only_declared
    if slip.pair in ("extent", "fieldName", "fieldDataType"):
        return slip.pair == "extent" and prim not in facts.prims.without_extent
    if slip.pair == "positions":
        is_likely = facts.particles.arrays(prim).lack_positions and slip.attribute.GetTypeName().isArray
        return not is_likely or not any(map(len, facts.prims.values(prim, slip.attribute.GetName())))
    return not facts.particles.arrays(prim).are_colourless or facts.particles.material_is_bound(prim)
