"""AST001: a field must name a file at some time."""

from usdvol_lint.rule import ERROR, INFO, AssetState, Facts, PathMark, Prim, Problem, Problems, file_paths, lacks, rule


@rule("AST001", on="FieldAsset", when=file_paths(PathMark.NONE), severity=ERROR, since="0.1")
def file_path_missing(field: Prim, facts: Facts) -> Problems:
    paths = facts.files.paths(field)
    is_told = facts.files.unlisted_clips(field) or facts.prims.is_told_as_misspelt(field, "filePath")
    if paths.names_a_path or is_told or facts.layers.may_lack_values(field):
        return
    absent = [lacks(field, "filePath")]
    if empty := facts.files.empty_clip(field):
        advice = "write the values into the clip itself: USD does not compose what a clip refers to"
        message = f"no filePath: {empty.words}"
        yield Problem(message, at=paths.attribute, spec=empty.spec, suggestion=advice, absent=absent)
        return
    what = "is empty" if paths.of(AssetState.EMPTY) else "is blocked" if paths.samples else "has no value"
    variant = None if paths.samples else facts.files.unselected_path(field)
    is_open = variant is not None and not variant.selected
    yield Problem(
        (f"filePath {what}" if paths.attribute.IsAuthored() else "no filePath") + (variant.words if variant else ""),
        at=paths.attribute,
        severity=INFO if is_open or paths.is_only_declared else None,
        suggestion=variant.advice if variant else "author the path of the file that holds the field",
        absent=absent,
    )
