"""GRD001: a field names volume files, and of the format that its type asks for."""

from usdvol_lint.rule import ERROR, Content, Facts, NotChecked, Prim, Problem, Problems, contents, rule

_FAULTS = ("not-a-volume-file", "not-a-file")
_FORMATS = {"openvdb": "an OpenVDB", "nanovdb": "a NanoVDB", "field3d": "a Field3D"}


def _unread(content: Content) -> str | None:
    return content.unread


def _stranger(content: Content) -> str | None:
    # What the other type of field reads, by another extension, is AST006.
    return None if content.swapped_format else content.unexpected_format


def _fault(content: Content) -> tuple[str, bool] | None:
    if content.fault and content.fault.code in _FAULTS:
        return content.fault.code, content.reading.file is not None
    return None


@rule("GRD001", on="FieldAsset", when=contents(_unread, _fault, _stranger), severity=ERROR, since="0.1")
def not_a_volume_file(field: Prim, facts: Facts) -> Problems:
    inside = facts.grids.contents(field)
    for unread, _, found in inside.grouped(_unread):
        yield NotChecked(
            f"{found.shown} was not looked into: {unread}{found.count}",
            at=found,
        )
    for (_, is_broken), content, found in inside.grouped(_fault):
        what = "broken" if is_broken else "no volume file"
        yield Problem(
            f"{found.shown} is {what}: {content.fault}{found.count}",
            at=found,
            suggestion="write it again, or copy it again" if is_broken else None,
        )
    for stranger, content, found in inside.grouped(_stranger):
        yield Problem(
            f"{found.shown} is {_FORMATS[stranger]} file, and {field.GetTypeName()} wants "
            f"{_FORMATS[content.wanted]} file{found.count}",
            at=found,
            suggestion="convert it" if stranger != "field3d" else "use a Field3DAsset",
        )
