"""AST001: a field must name a file at some time."""

from usdvol_lint.rule import ERROR, INFO, AssetState, Facts, PathMark, Prim, Problem, Problems, file_paths, rule


@rule("AST001", on="FieldAsset", when=file_paths(PathMark.NONE), severity=ERROR, since="0.1")
def file_path_missing(field: Prim, facts: Facts) -> Problems:
    paths = facts.files.paths(field)
    if paths.names_a_path or facts.files.unlisted_clips(field) or facts.layers.may_lack_values(field):
        return
    if paths.of(AssetState.EMPTY):
        message = "filePath is empty"
    elif paths.samples:
        message = "filePath is blocked"
    else:
        message = "filePath has no value" if paths.attribute.IsAuthored() else "no filePath"
    advice, level = "author the path of the file that holds the field", ERROR
    if variant := None if paths.samples else facts.files.unselected_path(field):
        advice, level = variant.advice, ERROR if variant.selected else INFO
    words = variant.words if variant else ""
    yield Problem(f"{message}{words}", at=paths.attribute, suggestion=advice, severity=level)
