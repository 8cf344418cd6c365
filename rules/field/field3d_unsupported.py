"""FLD007: Field3D files have a schema in USD, but no reader."""

from usdvol_lint.rule import INFO, Facts, Prim, Problem, Problems, rule


@rule("FLD007", on="Field3DAsset", severity=INFO, since="0.1")
def field3d_unsupported(field: Prim, facts: Facts) -> Problems:
    if facts.layers.hides_ours(field) or facts.grids.timelines(field).formats - {"field3d"}:
        return  # what is wrong is the type of the prim, or the file
    yield Problem(
        "no reader of Field3D files ships with OpenUSD",
        at=field,
        suggestion="convert the file to OpenVDB, and name it with an OpenVDBAsset",
    )
