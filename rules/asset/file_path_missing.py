"""AST001: a field must name a file at some time."""

from usdvol_lint.rule import ERROR, INFO, AssetState, Facts, PathMark, Prim, Problem, Problems, file_paths, lacks, rule


@rule("AST001", on="FieldAsset", when=file_paths(PathMark.NONE), severity=ERROR, since="0.1")
def file_path_missing(field: Prim, facts: Facts) -> Problems:
    paths = facts.files.paths(field)
    is_told = facts.files.unlisted_clips(field) or facts.prims.is_told_as_misspelt(field, "filePath")
    if paths.names_a_path or is_told or facts.layers.may_lack_values(field):
        return
    what = "is empty" if paths.of(AssetState.EMPTY) else "is blocked" if paths.samples else "has no value"
    yield Problem(
        f"filePath {what}" if paths.attribute.IsAuthored() else "no filePath",
        at=paths.attribute,
        severity=INFO if facts.files.is_only_declared(field) else None,
        suggestion="author the path of the file that holds the field",
        absent=[lacks(field, "filePath")],
    )
