"""FLD002: a field should say what type of data it holds."""

from usdvol_lint.rule import INFO, STAGE, Facts, Prim, Problem, Problems, lacks, rule
from usdvol_lint.schema import FIELD_ASSET


@rule("FLD002", on=STAGE, severity=INFO, since="0.1")
def field_data_type_missing(stage: Prim, facts: Facts) -> Problems:
    for field in sorted(_untyped(facts), key=facts.prims.shown_path):
        data_type = field.GetAttribute("fieldDataType")
        is_empty = "" in facts.prims.values(field, "fieldDataType")
        yield Problem(
            "fieldDataType is empty" if is_empty else "no fieldDataType",
            at=data_type if data_type.IsAuthored() else field,
            fold="fieldDataType",
            suggestion="author the type of the grid, such as 'float' or 'float3'",
            absent=[lacks(field, "fieldDataType")],
        )


def _untyped(facts: Facts) -> list[Prim]:
    """The fields that never say a type, and whose files hold grids of types that have a token."""
    claims = facts.grids.claims.readable(FIELD_ASSET)
    silent = {field for field, said in claims if not said.always_say_type}
    if not silent:
        return []
    return [
        field
        for field, timeline in facts.grids.timelines.readable(FIELD_ASSET)
        if field in silent and not timeline.lacks_data_type and _says_none(field, facts)
    ]


def _says_none(field: Prim, facts: Facts) -> bool:
    data_type = field.GetAttribute("fieldDataType")
    values = list(facts.prims.values(field, "fieldDataType"))
    if data_type.Get() or any(values) or ("" not in values and data_type.HasAuthoredValue()):
        return False
    is_told = facts.prims.is_told_as_misspelt(field, "fieldDataType")
    return not is_told and not facts.layers.may_lack_values(field)
