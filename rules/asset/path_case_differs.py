"""AST009: a path must have the case of the names that it leads to."""

from usdvol_lint.rule import WARNING, Facts, PathMark, Prim, Problem, Problems, file_paths, quoted, rule


@rule("AST009", on="FieldAsset", when=file_paths(PathMark.CASE_BLIND), severity=WARNING, since="0.1")
def path_case_differs(field: Prim, facts: Facts) -> Problems:
    recased = facts.files.recased(field)
    if recased:
        affected = recased.affected
        yield Problem(
            f"{affected.shown} is {quoted(recased.path)} on disk, in another case{affected.count}",
            at=affected,
            suggestion=f"write it as {quoted(recased.path)}",
        )
