"""AST006: a field's file must have the extension that its readers are chosen by."""

from usdvol_lint.rule import WARNING, Facts, PathMark, Prim, Problem, Problems, file_paths, rule
from usdvol_lint.schema import FILE_EXTENSIONS

_TYPES = {extension: name for name, extension in FILE_EXTENSIONS.items()}


@rule("AST006", on=tuple(_TYPES.values()), when=file_paths(PathMark.FOREIGN), severity=WARNING, since="0.1")
def extension_unexpected(field: Prim, facts: Facts) -> Problems:
    wanted = ".vdb" if facts.prims.is_a(field, "OpenVDBAsset") else ".f3d"
    paths = facts.files.paths(field)
    other = paths.affected(each for each in paths.samples if each.is_there and each.extension != wanted)
    if other:
        extension = other.first.extension
        if (extension, wanted) == (".nvdb", ".vdb"):
            what = "is a NanoVDB file, which some renderers read and Storm does not"
            advice = "write it as '.vdb' for renderers that read OpenVDB alone"
        else:
            what = f"does not end in '{wanted}', as the files of an {_TYPES[wanted]} do"
            advice = f"name a '{wanted}' file"
        if extension in _TYPES:
            advice += f", or make the prim an {_TYPES[extension]}"
        yield Problem(
            f"{other.shown} {what}{other.count}",
            at=other,
            suggestion=advice,
        )
