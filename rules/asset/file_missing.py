"""AST002: the file that a field names must exist."""

from usdvol_lint.rule import ERROR, AssetState, Facts, Prim, Problem, Problems, file_paths, rule


@rule("AST002", on="FieldAsset", when=file_paths(AssetState.MISSING), severity=ERROR, since="0.1")
def file_missing(field: Prim, facts: Facts) -> Problems:
    missing = facts.files.missing(field)
    if missing:
        fields = facts.files.sharing_missing_folder(field)
        alike = facts.files.alike(field)
        if fields[0] != field if fields else not alike.is_first:
            return
        absence = facts.files.absence(missing.anchored(), missing.first.path)
        others, (what, count) = len(fields) - 1, missing.nothing_there
        below = f", where {others} other field{'s' * (others > 1)} should have files too" if others > 0 else ""
        yield Problem(
            f"{what}{absence.reason}{below if fields else alike.others}{count}",
            at=missing,
            suggestion=absence.advice or facts.files.what_to_write(field),
        )
