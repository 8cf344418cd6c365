"""AST001: a field must name a file at some time."""

from usdvol_lint.rule import ERROR, INFO, AssetState, Facts, PathMark, Prim, Problem, Problems, file_paths, quoted, rule


@rule("AST001", on="FieldAsset", when=file_paths(PathMark.NONE), severity=ERROR, since="0.1")
def file_path_missing(field: Prim, facts: Facts) -> Problems:
    paths = facts.files.paths(field)
    if paths.names_a_path or facts.files.unlisted_clips(field):
        return
    if facts.layers.may_lack_values(field):
        return
    if paths.of(AssetState.EMPTY):
        message = "filePath is empty"
    elif paths.samples:
        message = "filePath is blocked"
    else:
        message = "filePath has no value" if paths.attribute.IsAuthored() else "no filePath"
    variant = None if paths.samples else facts.files.unselected_path(field)
    if variant is None:
        yield Problem(message, at=paths.attribute, suggestion="author the path of the file that holds the field")
        return
    where = f"variant set {quoted(variant.set_name)}"
    has = f"the variant {quoted(variant.name)} of the {where} has one"
    advice = f"author it in the variant {quoted(variant.selected)} of the {where}"
    if not variant.selected:
        advice = f"select a variant of the {where}"
    yield Problem(
        f"{message}, but {has}, and {'another' if variant.selected else 'none'} is selected",
        at=paths.attribute,
        suggestion=f"{advice}: a path outside of it would hold for all variants",
        severity=None if variant.selected else INFO,
    )
