"""AST001: a field must name a file at some time."""

from usdvol_lint.rule import ERROR, AssetState, Facts, PathMark, Prim, Problem, Problems, file_paths, quoted, rule


@rule("AST001", on="FieldAsset", when=file_paths(PathMark.NONE), severity=ERROR, since="0.1")
def file_path_missing(field: Prim, facts: Facts) -> Problems:
    paths = facts.files.paths(field)
    if paths.names_a_path or facts.files.unlisted_clips(field):
        return
    if facts.layers.may_lack_values(field):
        return
    empty = facts.files.empty_clip(field)
    if empty:
        yield Problem(
            f"no filePath: the clip {quoted(empty.clip)} has <{empty.prim_path}>, and no value for this field",
            at=paths.attribute,
            spec=empty.spec,
            suggestion="write the values into the clip itself: USD does not compose what a clip refers to",
        )
        return
    if paths.of(AssetState.EMPTY):
        message = "filePath is empty"
    elif paths.samples:
        message = "filePath is blocked"
    else:
        message = "filePath has no value" if paths.attribute.IsAuthored() else "no filePath"
    yield Problem(message, at=paths.attribute, suggestion="author the path of the file that holds the field")
