"""AST008: a path must be written so that every platform reads it alike."""

from typing import Any

from usdvol_lint.rule import ERROR, WARNING, Facts, PathMark, Prim, Problem, Problems, file_paths, quoted, rule


@rule("AST008", on="FieldAsset", when=file_paths(PathMark.UNPLAIN), severity=ERROR, since="0.1")
def path_malformed(field: Prim, facts: Facts) -> Problems:
    for malformed in facts.files.malformed(field):
        affected = malformed.affected
        defects = ", and ".join(malformed.defects)
        effect = ", so no file is found" if malformed.is_cause else ""
        yield Problem(
            f"{affected.shown} {defects}{effect}{affected.count}",
            at=affected,
            fold=facts.files.alike(field),
            suggestion=_advice(malformed),
            severity=None if malformed.is_cause else WARNING,
        )


def _advice(malformed: Any) -> str:
    if not malformed.corrected:
        return "name it in relation to the layer, with '/' between names"
    is_gone = malformed.is_cause and not malformed.leads_to_file
    return f"write it as {quoted(malformed.corrected)}" + ", where no file is either" * is_gone
