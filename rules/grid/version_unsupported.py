"""GRD010: the version of a file must be one that readers know."""

from collections.abc import Callable
from functools import cache
from typing import Any

from usdvol_lint.rule import WARNING, Content, Facts, Prim, Problem, Problems, When, rule


def _reason(content: Content, newest: int) -> str | None:
    if content.fault is not None:
        return content.fault.message if content.fault.code == "version-unsupported" else None
    file = content.file
    if file is None:
        return None
    if file.format == "openvdb":
        newer = f"file version {file.version} is newer than {newest}"
        return newer if file.version_number > newest else None
    warnings = (warning.message for warning in file.warnings if warning.code == "version-newer")
    return next(warnings, None)


@cache
def _unsupported(newest: int) -> Callable[[Content], object]:
    def version(content: Content) -> object:
        file = content.reading.file
        unsupported = _reason(content, newest) is not None
        return (file and file.version, content.fault is None) if unsupported else None

    return version


def _holds(kinds: tuple[Any, ...], newest: int) -> bool:
    return any(kind.answer(_unsupported(newest)) is not None for kind in kinds)


@rule("GRD010", on="FieldAsset", when=When("content_kinds", _holds), severity=WARNING, since="0.1")
def version_unsupported(field: Prim, facts: Facts, *, newest: int = 225) -> Problems:
    for content, found in facts.contents(field).grouped(_unsupported(newest)):
        yield Problem(
            f"{found.shown}: {_reason(content, newest)}{found.count}",
            at=found.attribute,
            times=found.times,
            at_default=found.at_default,
            asset=found.first.authored,
            suggestion="write it again with another version of the library",
        )
