"""GRD001: a field names volume files, and of the format that its type asks for."""

from usdvol_lint.rule import ERROR, WARNING, Content, Facts, NotChecked, Prim, Problem, Problems, contents, rule

_FAULTS = ("not-a-volume-file", "not-a-file")
_AS_IT_IS = "make the prim an OpenVDBAsset, and end the file's name in '.vdb'"
_CONVERTED = "convert it to OpenVDB, and name it with an OpenVDBAsset: OpenUSD has no reader of other files"


def _unread(content: Content) -> str | None:
    return content.unread


def _stranger(content: Content) -> str | None:
    return content.unexpected_format


def _fault(content: Content) -> tuple[str, bool] | None:
    if content.fault and content.fault.code in _FAULTS:
        return content.fault.code, content.reading.file is not None
    return None


@rule("GRD001", on="FieldAsset", when=contents(_unread, _fault, _stranger), severity=ERROR, since="0.1")
def not_a_volume_file(field: Prim, facts: Facts) -> Problems:
    inside, alike = facts.grids.unswapped(field), facts.files.alike(field)
    for unread, _, found in inside.grouped(_unread):
        machine = "h5py" if "h5py" in unread else None
        yield NotChecked(
            f"{found.shown} was not looked into: {unread}{found.count}", at=found, machine=machine, fold=alike
        )
    for (_, is_broken), content, found in inside.grouped(_fault):
        what = "broken" if is_broken else "not a volume file"
        yield Problem(
            f"{found.shown} is {what}: {content.fault}{found.count}",
            at=found,
            fold=alike,
            suggestion="write or copy it again",
        )
    for stranger, content, found in inside.grouped(_stranger):
        yield Problem(
            f"{found.shown} is {content.foreign}{found.count}",
            at=found,
            subject=stranger,
            fold=alike,
            suggestion=_AS_IT_IS if stranger == "openvdb" else _CONVERTED,
            severity=WARNING if content.is_read_by_some else None,
        )
