"""AST001: a field must name a file at some time."""

from usdvol_lint.rule import ERROR, INFO, AssetState, Facts, PathMark, Prim, Problem, Problems, file_paths, lacks, rule


@rule("AST001", on="FieldAsset", when=file_paths(PathMark.NONE), severity=ERROR, since="0.1")
def file_path_missing(field: Prim, facts: Facts) -> Problems:
    paths = facts.files.paths(field)
    is_told = facts.prims.is_told_as_misspelt(field, "filePath")
    if paths.names_a_path or is_told or facts.layers.may_lack_values(field, "filePath"):
        return
    absent = [lacks(field, "filePath")]
    hidden = "but the default time" if paths.hidden_default else ""
    if empty := facts.files.empty_clip(field):
        yield Problem(
            f"no filePath{f' at any time {hidden}' if hidden else ''}: {empty.words}",
            at=paths.attribute,
            spec=empty.spec,
            suggestion=empty.advice,
            absent=absent,
        )
        return
    what = "is empty" if paths.of(AssetState.EMPTY) else "is blocked" if paths.samples else "has no value"
    what += f" at all times {hidden}" if hidden else ""
    variant = None if paths.samples else facts.files.unselected_path(field)
    is_open = variant is not None and not variant.selected
    advice = "author the path of the file that holds the field"
    if hidden:
        advice = "author files in the time samples, or remove these"
    yield Problem(
        (f"filePath {what}" if paths.attribute.IsAuthored() else "no filePath") + (variant.words if variant else ""),
        at=paths.attribute,
        severity=INFO if is_open or paths.is_only_declared else None,
        suggestion=variant.advice if variant else advice,
        absent=absent,
    )
