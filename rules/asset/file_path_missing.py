"""AST001: a field must name a file at some time."""

from usdvol_lint.rule import (
    ERROR,
    INFO,
    AssetState,
    Facts,
    PathMark,
    Prim,
    Problem,
    Problems,
    file_paths,
    lacking,
    rule,
)


@rule("AST001", on="FieldAsset", when=file_paths(PathMark.NONE), severity=ERROR, since="0.1")
def file_path_missing(field: Prim, facts: Facts) -> Problems:
    paths = facts.files.paths(field)
    if paths.names_a_path or facts.files.unlisted_clips(field):
        return
    if facts.layers.may_lack_values(field):
        return
    severity = None
    if paths.of(AssetState.EMPTY):
        message = "filePath is empty"
    elif paths.samples:
        message = "filePath is blocked"
    else:
        message = "filePath has no value" if paths.attribute.IsAuthored() else "no filePath"
        root = facts.stage.GetRootLayer()
        severity = INFO if any(spec.layer == root for spec in paths.attribute.GetPropertyStack()) else None
    yield Problem(
        message,
        at=paths.attribute,
        severity=severity,
        suggestion="author the path of the file that holds the field",
        absent=[lacking(field, "filePath")],
    )
