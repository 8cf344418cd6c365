"""AST007: an absolute path leads to a file on few machines."""

import re

from usdvol_lint.rule import INFO, AssetState, Facts, PathMark, Prim, Problem, Problems, file_paths, quoted, rule

_ABSOLUTE = re.compile(r"/|\\\\|[A-Za-z]:")


@rule("AST007", on="FieldAsset", when=file_paths(PathMark.UNPLAIN), severity=INFO, since="0.1")
def path_absolute(field: Prim, facts: Facts) -> Problems:
    paths = facts.files.paths(field)
    found = paths.matching(_ABSOLUTE)
    if found is None or (AssetState.MISSING in paths.states and facts.tells("AST002")):
        return
    if facts.tells("AST015") and facts.files.outside_package(field):
        return
    # An expression takes its root from a variable, which each place may set.
    absolute = paths.affected(sample for sample in found.samples if sample.authored == sample.path)
    if absolute:
        below = absolute.below_layer
        yield Problem(
            f"{absolute.shown} is an absolute path{absolute.count}",
            at=absolute,
            suggestion=f"name it in relation to the layer: {quoted(below)}"
            if below
            else "name it in relation to the layer, or take its root from an expression variable",
        )
