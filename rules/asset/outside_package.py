"""AST015: a package must hold the files that it names."""

from usdvol_lint.rule import ERROR, WARNING, Facts, PathMark, Prim, Problem, Problems, file_paths, rule


@rule("AST015", on="FieldAsset", when=file_paths(PathMark.PACKAGED), severity=ERROR, since="0.1")
def outside_package(field: Prim, facts: Facts) -> Problems:
    outside = facts.files.outside_package(field)
    if outside:
        effect = ", so no file is found" if outside.has_missing else ""
        yield Problem(
            f"{outside.shown} lies outside the package that names it{effect}{outside.count}",
            at=outside,
            fold=facts.files.alike(field),
            suggestion="add the file to the package, and name it in relation to the layer",
            severity=None if outside.has_missing else WARNING,
        )
