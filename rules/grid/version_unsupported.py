"""GRD010: the version of a file must be one that readers know."""

from usdvol_lint.rule import WARNING, Content, Facts, Prim, Problem, Problems, rule


@rule("GRD010", on="FieldAsset", severity=WARNING, since="0.1")
def version_unsupported(field: Prim, facts: Facts, *, newest: int = 225) -> Problems:
    for content, found in facts.contents(field).grouped(_version):
        version, said = _version(content)
        if version is not None and version <= newest:
            continue
        yield Problem(
            f"{found.shown}: {said or f'file version {version} is newer than {newest}'}"
            f"{found.count}",
            at=found.attribute,
            times=found.times,
            at_default=found.at_default,
            asset=found.first.authored,
            suggestion="write it again with another version of the library",
        )


def _version(content: Content) -> tuple[int | None, str] | None:
    """The file's version, or what the reader says of it."""
    if content.fault is not None:
        code, message, _ = content.fault
        return (None, message) if code == "version-unsupported" else None
    file = content.file
    if file is None:
        return None
    if file.format == "openvdb":
        return file.version_number, ""
    warnings = (warning.message for warning in file.warnings if warning.code == "version-newer")
    return next(((None, message) for message in warnings), None)
