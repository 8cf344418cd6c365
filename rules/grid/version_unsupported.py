"""GRD010: the version of a file must be one that readers know."""

from dataclasses import dataclass

from usdvol_lint.rule import WARNING, Content, ContentClass, Facts, Grids, Prim, Problem, Problems, When, rule

_NEWER = "write it again with the version of the library that your renderers have"
_OLDER = "open it with the program that wrote it, and write it again with a newer one"


@dataclass(frozen=True)
class _Unsupported:
    """The version of a file that readers may not know; `newest` is what they know of OpenVDB."""

    newest: int

    def __call__(self, content: Content) -> tuple[str, bool] | None:
        """The version, and whether the file was read: what the reason says has numbers in it."""
        file = content.reading.file
        return (file.version if file else "", content.fault is None) if self.reason(content) else None

    def reason(self, content: Content) -> str | None:
        if content.fault is not None:
            return content.fault.message if content.fault.code == "version-unsupported" else None
        file = content.file
        if file is None:
            return None
        if file.format == "openvdb":
            newer = f"file version {file.version} is newer than {self.newest}"
            return newer if file.version_number > self.newest else None
        return file.newer


def _some_are_unsupported(classes: tuple[ContentClass, ...], newest: int) -> bool:
    return any(each.answer(_Unsupported(newest)) is not None for each in classes)


@rule("GRD010", on="FieldAsset", when=When(Grids.content_classes, _some_are_unsupported), severity=WARNING, since="0.1")
def version_unsupported(field: Prim, facts: Facts, *, newest: int = 225) -> Problems:
    unsupported, alike = _Unsupported(newest), facts.files.alike(field)
    for (_, is_newer), content, found in facts.grids.contents(field).grouped(unsupported):
        yield Problem(
            f"{found.shown}: {unsupported.reason(content)}{found.count}",
            at=found,
            fold=alike,
            suggestion=_NEWER if is_newer else _OLDER,
        )
