"""SCH002: abstract types are there to inherit from, not to instantiate."""

from usdvol_lint.rule import ABSTRACT_TYPE, ERROR, TYPE, WARNING, Facts, Prim, Problem, Problems, rule
from usdvol_lint.schema import ABSTRACT_TYPES, FIELD_ASSET


@rule("SCH002", on=ABSTRACT_TYPE, severity=ERROR, since="0.1")
def abstract_type(prim: Prim, facts: Facts) -> Problems:
    name = prim.GetTypeName()
    if name in ABSTRACT_TYPES:
        is_for_index = name == FIELD_ASSET and facts.grids.is_for_index(prim)
        yield Problem(
            f"type {name!r} is abstract, so this prim is no field to USD"
            + (": only NVIDIA IndeX reads it" if is_for_index else ""),
            at=prim,
            of=TYPE,
            severity=WARNING if is_for_index else None,
            suggestion="leave it as it is for IndeX; for other renderers add an OpenVDBAsset with a .vdb file"
            if is_for_index
            else "make it an OpenVDBAsset (.vdb) or a Field3DAsset (.f3d)",
        )
