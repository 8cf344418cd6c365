"""AST015: a package must hold the files that it names."""

from usdvol_lint.rule import WARNING, Facts, PathMark, Prim, Problem, Problems, file_paths, rule


@rule("AST015", on="FieldAsset", when=file_paths(PathMark.PACKAGED), severity=WARNING, since="0.1")
def outside_package(field: Prim, facts: Facts) -> Problems:
    outside = facts.files.outside_package(field)
    if outside:
        yield Problem(
            f"{outside.shown} lies outside the package that names it{outside.count}",
            at=outside,
            suggestion="add the file to the package, and name it in relation to the layer",
        )
