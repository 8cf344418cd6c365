"""AST009: a path must have the case of the names that it leads to."""

from usdvol_lint.rule import (
    WARNING,
    Facts,
    PathMark,
    Prim,
    Problem,
    Problems,
    file_paths,
    quoted,
    rule,
)


@rule(
    "AST009", on="FieldAsset", when=file_paths(PathMark.CASE_BLIND), severity=WARNING, since="0.1"
)
def path_case_differs(field: Prim, facts: Facts) -> Problems:
    recased = facts.recased(field, "filePath")
    if recased:
        affected = recased.affected
        yield Problem(
            f"{affected.shown} is {quoted(recased.path)} on disk, in another case{affected.count}",
            at=affected.attribute,
            times=affected.times,
            at_default=affected.at_default,
            asset=affected.first.authored,
            suggestion=f"write it as {quoted(recased.path)}",
        )
