"""AST002: the file that a field names must exist."""

from usdvol_lint.rule import ERROR, AssetState, Facts, Prim, Problem, Problems, file_paths, rule


@rule("AST002", on="FieldAsset", when=file_paths(AssetState.MISSING), severity=ERROR, since="0.1")
def file_missing(field: Prim, facts: Facts) -> Problems:
    every = facts.files.missing(field)
    for missing in every.by_opinion if every else ():
        absence = facts.files.absence(missing.place, missing.first.path)
        what, count = missing.nothing_there
        yield Problem(
            f"{what}{absence.reason}{count}",
            at=missing,
            fold=facts.files.missing_folder(field) or facts.files.alike(field),
            suggestion=absence.advice or facts.files.what_to_write(field),
        )
