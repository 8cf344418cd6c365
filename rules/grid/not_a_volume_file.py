"""GRD001: a field names volume files, and of the format that its type asks for."""

from usdvol_lint.rule import (
    ERROR,
    Content,
    Facts,
    NotChecked,
    Prim,
    Problem,
    Problems,
    contents,
    rule,
)

_FAULTS = ("not-a-volume-file", "not-a-file")
_FORMATS = {"openvdb": "an OpenVDB", "nanovdb": "a NanoVDB", "field3d": "a Field3D"}


def _unread(content: Content) -> object:
    return content.unread


def _stranger(content: Content) -> object:
    return content.stranger


def _fault(content: Content) -> object:
    if content.fault and content.fault.code in _FAULTS:
        return content.fault.code, content.reading.file is None
    return None


@rule(
    "GRD001",
    on="FieldAsset",
    when=contents(_unread, _fault, _stranger),
    severity=ERROR,
    since="0.1",
)
def not_a_volume_file(field: Prim, facts: Facts) -> Problems:
    contents = facts.contents(field)
    for content, found in contents.grouped(_unread):
        yield NotChecked(
            f"{found.shown} was not looked into: {content.unread}{found.count}",
            at=found.attribute,
            times=found.times,
            at_default=found.at_default,
            asset=found.first.authored,
        )
    for content, found in contents.grouped(_fault):
        is_broken = content.reading.file is not None
        what = "broken" if is_broken else "no volume file"
        yield Problem(
            f"{found.shown} is {what}: {content.fault}{found.count}",
            at=found.attribute,
            times=found.times,
            at_default=found.at_default,
            asset=found.first.authored,
            suggestion="write it again, or copy it again" if is_broken else None,
        )
    for content, found in contents.grouped(_stranger):
        yield Problem(
            f"{found.shown} is {_FORMATS[content.stranger]} file, and {field.GetTypeName()} wants "
            f"{_FORMATS[content.wanted]} file{found.count}",
            at=found.attribute,
            times=found.times,
            at_default=found.at_default,
            asset=found.first.authored,
            suggestion="convert it" if content.stranger != "field3d" else "use a Field3DAsset",
        )
