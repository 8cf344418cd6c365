"""AST009: a path must have the case of the names that it leads to."""

from usdvol_lint.rule import ERROR, WARNING, Facts, PathMark, Prim, Problem, Problems, file_paths, quoted, rule


@rule("AST009", on="FieldAsset", when=file_paths(PathMark.CASE_BLIND), severity=ERROR, since="0.1")
def path_case_differs(field: Prim, facts: Facts) -> Problems:
    recased = facts.files.recased(field)
    if recased:
        affected, meant = recased.affected, quoted(recased.path)
        effect = ", so no file is found" if affected.has_missing else ""
        yield Problem(
            f"{affected.shown} is {meant} on disk, in another case{effect}{affected.count}",
            at=affected,
            fold=facts.files.alike(field),
            suggestion=f"write it as {meant}",
            severity=None if affected.has_missing else WARNING,
        )
