"""GRD010: the version of a file must be one that readers know."""

from usdvol_lint.rule import WARNING, Content, Facts, Prim, Problem, Problems, rule


@rule("GRD010", on="FieldAsset", severity=WARNING, since="0.1")
def version_unsupported(field: Prim, facts: Facts, *, newest: int = 225) -> Problems:
    contents = facts.contents(field)
    for content, found in contents.grouped(lambda content: _version(content, newest)):
        yield Problem(
            f"{found.shown}: {_version(content, newest)}{found.count}",
            at=found.attribute,
            times=found.times,
            at_default=found.at_default,
            asset=found.first.authored,
            suggestion="write it again with another version of the library",
        )


def _version(content: Content, newest: int) -> str | None:
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
