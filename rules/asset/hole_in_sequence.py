"""AST018: between frames that have a file there should be none without."""

from usdvol_lint.rule import INFO, WARNING, AssetState, Facts, Prim, Problem, Problems, file_paths, frame_ranges, rule

_NOTHING = file_paths(AssetState.BLOCKED, AssetState.EMPTY)


@rule("AST018", on="FieldAsset", when=_NOTHING, severity=WARNING, since="0.1")
def hole_in_sequence(field: Prim, facts: Facts) -> Problems:
    holes = facts.files.holes(field)
    if holes and not facts.layers.may_lack_values(field):
        affected = holes.affected
        if facts.volumes.is_hidden(field, affected.times):
            return
        what = "the clip there has no filePath" if holes.clip else "filePath is empty or blocked"
        yield Problem(
            f"no file at {frame_ranges(affected.times)}, though there are files before and after: {what}",
            at=affected.attribute,
            times=affected.times,
            asset=holes.clip,
            spec=holes.spec,
            of="clips",
            fold=facts.files.alike(field),
            suggestion=holes.advice or "write the files that are missing, or leave it, if nothing is to be seen then",
            severity=None if holes.paths else INFO,
        )
