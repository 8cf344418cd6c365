"""SCH002: abstract types are there to inherit from, not to instantiate."""

from usdvol_lint.rule import ABSTRACT_TYPE, ERROR, Facts, Prim, Problem, Problems, rule
from usdvol_lint.schema import ABSTRACT_TYPES


@rule("SCH002", on=ABSTRACT_TYPE, severity=ERROR, since="0.1")
def abstract_type(prim: Prim, facts: Facts) -> Problems:
    if prim.GetTypeName() in ABSTRACT_TYPES:
        yield Problem(
            f"type {prim.GetTypeName()!r} is abstract, so this prim is no field to USD",
            at=prim,
            suggestion="make it an OpenVDBAsset (.vdb) or a Field3DAsset (.f3d)",
        )
