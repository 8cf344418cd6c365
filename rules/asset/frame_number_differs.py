"""AST013: a file's frame number should follow the time as those of all other samples do."""

from usdvol_lint.rule import WARNING, Facts, PathMark, Prim, Problem, Problems, file_paths, quoted, rule


@rule("AST013", on="FieldAsset", when=file_paths(PathMark.SEVERAL), severity=WARNING, since="0.1")
def frame_number_differs(field: Prim, facts: Facts) -> Problems:
    sequence = facts.files.sequence(field)
    strays = sequence.strays() if sequence else None
    if strays:
        affected = strays.affected
        yield Problem(
            f"{affected.shown} is out of the order that the other file numbers keep{affected.count}",
            at=affected,
            suggestion=f"did you mean {quoted(strays.meant)}?" if strays.meant else None,
        )
