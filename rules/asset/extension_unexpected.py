"""AST006: a field's file must have the extension that its readers are chosen by."""

from usdvol_lint.rule import ERROR, WARNING, Content, Facts, PathMark, Prim, Problem, Problems, file_paths, rule
from usdvol_lint.schema import FILE_EXTENSIONS

_TYPES = {extension: name for name, extension in FILE_EXTENSIONS.items()}
_FORMATS = {".vdb": "an OpenVDB", ".f3d": "a Field3D"}
_EXTENSIONS = {"openvdb": ".vdb", "field3d": ".f3d"}


def _swapped(content: Content) -> str | None:
    return content.swapped_format


@rule("AST006", on=tuple(_TYPES.values()), when=file_paths(PathMark.FOREIGN), severity=ERROR, since="0.1")
def extension_unexpected(field: Prim, facts: Facts) -> Problems:
    if facts.layers.hides_ours(field):
        return
    wanted = ".vdb" if facts.prims.is_a(field, "OpenVDBAsset") else ".f3d"
    paths = facts.files.paths(field)
    swapped = facts.grids.contents(field).grouped(_swapped)
    for found_format, _, found in swapped:
        extension = _EXTENSIONS[found_format]
        yield Problem(
            f"{found.shown} is {_FORMATS[extension]} file, and {_TYPES[wanted]} wants "
            f"{_FORMATS[wanted]} file{found.count}",
            at=found,
            suggestion=f"name a '{wanted}' file, or make the prim {_FORMATS[extension]}Asset",
        )
    accounted = {sample.extension for _, _, found in swapped for sample in found.samples}
    other = paths.affected(
        each for each in paths.samples if each.is_there and each.extension not in (wanted, *accounted)
    )
    if other:
        extension = other.first.extension
        if (extension, wanted) == (".nvdb", ".vdb"):
            what = "is a NanoVDB file, which some renderers read and Storm does not"
            advice = "write it as '.vdb' for renderers that read OpenVDB alone"
        else:
            what = f"does not end in '{wanted}', as the file of {_FORMATS[wanted]}Asset does"
            advice = f"name a '{wanted}' file"
        if extension in _TYPES:
            advice += f", or make the prim {_FORMATS[extension]}Asset"
        yield Problem(
            f"{other.shown} {what}{other.count}",
            at=other,
            severity=WARNING,
            suggestion=advice,
        )
