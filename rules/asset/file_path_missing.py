"""AST001: a field must name a file at some time."""

from usdvol_lint.rule import ERROR, INFO, AssetState, Facts, PathMark, Prim, Problem, Problems, file_paths, lacks, rule


@rule("AST001", on="FieldAsset", when=file_paths(PathMark.NONE), severity=ERROR, since="0.1")
def file_path_missing(field: Prim, facts: Facts) -> Problems:
    paths = facts.files.paths(field)
    if paths.names_a_path or facts.files.unlisted_clips(field) or facts.layers.may_lack_values(field):
        return
    if empty := facts.files.empty_clip(field):
        yield Problem(
            f"no filePath: {empty.words}",
            at=paths.attribute,
            spec=empty.spec,
            suggestion="write the values into the clip itself: USD does not compose what a clip refers to",
            absent=[lacks(field, "filePath")],
        )
        return
    what = "is empty" if paths.of(AssetState.EMPTY) else "is blocked" if paths.samples else "has no value"
    message = f"filePath {what}" if paths.attribute.IsAuthored() else "no filePath"
    variant = None if paths.samples else facts.files.unselected_path(field)
    is_open = variant is not None and not variant.selected
    yield Problem(
        message + (variant.words if variant else ""),
        at=paths.attribute,
        severity=INFO if is_open or facts.files.is_only_declared(field) else None,
        suggestion=variant.advice if variant else "author the path of the file that holds the field",
        absent=[lacks(field, "filePath")],
    )
