"""AST006: a field's file must have the extension that its readers are chosen by."""

from operator import attrgetter
from typing import Any

from usdvol_lint.rule import ERROR, WARNING, Facts, PathMark, Prim, Problem, Problems, file_paths, rule
from usdvol_lint.schema import FILE_EXTENSIONS, TYPE_NAME

_TYPES = {"OpenVDBAsset": "an OpenVDBAsset", "Field3DAsset": "a Field3DAsset"}
_other_format = attrgetter("swapped_format")


@rule("AST006", on=tuple(_TYPES), when=file_paths(PathMark.FOREIGN), severity=ERROR, since="0.1")
def extension_unexpected(field: Prim, facts: Facts) -> Problems:
    type_name = next(name for name in _TYPES if facts.prims.is_a(field, name))
    if facts.layers.hides_ours(field):
        return
    alike = facts.files.alike(field)
    where: dict[str, Any] = {"against": [(field, TYPE_NAME)], "fold": alike and f"{alike} {type_name}"}
    paths, inside, wanted = facts.files.paths(field), facts.grids.contents(field), FILE_EXTENSIONS[type_name]
    for other, content, found in (others := inside.grouped(_other_format)):
        yield Problem(
            f"{found.shown} is {content.foreign}{found.count}",
            at=found,
            subject=other,
            suggestion=_advice(other, found.first.extension),
            severity=WARNING if content.is_read_by_some else None,
            **where,
        )
    by_content = inside.grouped(lambda content: content.is_no_volume or None) if facts.tells("GRD001") else ()
    accounted = {wanted, *(sample.extension for _, _, found in (*others, *by_content) for sample in found.samples)}
    misnamed = paths.affected(each for each in paths.samples if each.is_there and each.extension not in accounted)
    if misnamed:
        formats = inside.timeline.formats
        what = f"does not end in '{wanted}', as the file of {_TYPES[type_name]} does"
        advice = f"end its name in '{wanted}'" if formats else f"name a '{wanted}' file"
        if (misnamed.first.extension, wanted) == (".nvdb", ".vdb") and "openvdb" not in formats:
            what = "is a NanoVDB file, which some renderers read and Storm does not"
            advice = "write it as '.vdb' for renderers that read OpenVDB alone"
        said = f"{misnamed.shown} {what}{misnamed.count}"
        yield Problem(said, at=misnamed, suggestion=advice, severity=WARNING, **where)


def _advice(other: str, extension: str) -> str:
    if other == "openvdb":
        return "make the prim an OpenVDBAsset" + ", and end the file's name in '.vdb'" * (extension != ".vdb")
    return "convert it to OpenVDB, for an OpenVDBAsset: no reader of other files ships with OpenUSD"
