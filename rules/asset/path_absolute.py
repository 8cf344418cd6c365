"""AST007: an absolute path leads to a file on few machines."""

import re

from usdvol_lint.rule import (
    INFO,
    AssetState,
    Facts,
    PathMark,
    Prim,
    Problem,
    Problems,
    file_paths,
    quoted,
    rule,
)

_ABSOLUTE = re.compile(r"/|\\\\|[A-Za-z]:")
_STATES = (AssetState.FILE, AssetState.MISSING, AssetState.NOT_A_FILE, AssetState.PATTERN)


@rule("AST007", on="FieldAsset", when=file_paths(PathMark.UNPLAIN), severity=INFO, since="0.1")
def path_absolute(field: Prim, facts: Facts) -> Problems:
    paths = facts.assets(field, "filePath")
    found = paths.matching(_ABSOLUTE, *_STATES)
    if found is None or facts.outside_package(field, "filePath"):
        return
    # An expression takes its root from a variable, which each place may set.
    absolute = paths.affected(sample for sample in found.samples if sample.authored == sample.path)
    if absolute:
        below = facts.below_layer(absolute)
        yield Problem(
            f"{absolute.shown} is an absolute path{absolute.count}",
            at=absolute.attribute,
            times=absolute.times,
            at_default=absolute.at_default,
            asset=absolute.first.authored,
            suggestion=f"name it in relation to the layer: {quoted(below)}"
            if below
            else "name it in relation to the layer, or take its root from an expression variable",
        )
