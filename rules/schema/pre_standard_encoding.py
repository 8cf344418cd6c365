"""SCH011: volumes and splats in encodings from before the schema are none to other readers."""

from usdvol_lint.rule import UNKNOWN_TYPE, WARNING, Facts, Prim, Prims, Problem, Problems, When, rule


@rule(
    "SCH011",
    on=(UNKNOWN_TYPE, "Points", "Scope", "ParticleField", "Volume"),
    when=When(Prims.may_be_encoded_otherwise, bool),
    severity=WARNING,
    since="0.1",
)
def pre_standard_encoding(prim: Prim, facts: Facts) -> Problems:
    encoding = facts.prims.encoding(prim)
    if encoding:
        yield Problem(
            f"not UsdVol but {encoding.origin} ({encoding.sign})",
            at=prim,
            suggestion=encoding.advice,
        )
