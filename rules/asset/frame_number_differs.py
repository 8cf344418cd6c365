"""AST013: a file's frame number should follow the time as those of all other samples do."""

from usdvol_lint.rule import WARNING, Facts, PathMark, Prim, Problem, Problems, file_paths, quoted, rule


@rule("AST013", on="FieldAsset", when=file_paths(PathMark.SEVERAL), severity=WARNING, since="0.1")
def frame_number_differs(field: Prim, facts: Facts) -> Problems:
    out_of_order = facts.files.out_of_order(field)
    if out_of_order:
        affected, likely = out_of_order
        yield Problem(
            f"{affected.shown} is out of the order that the other file numbers keep{affected.count}",
            at=affected,
            fold=facts.files.alike(field),
            suggestion=f"did you mean {quoted(likely)}?" if likely else None,
        )
