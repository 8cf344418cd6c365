"""GRD002: a file must be as long as it says."""

from usdvol_lint.rule import ERROR, Content, Facts, Prim, Problem, Problems, contents, rule


def _cut(content: Content) -> bool | None:
    return True if content.fault and content.fault.code == "truncated" else None


@rule("GRD002", on="FieldAsset", when=contents(_cut), severity=ERROR, since="0.1")
def file_truncated(field: Prim, facts: Facts) -> Problems:
    for _, content, found in facts.grids.contents(field).grouped(_cut):
        yield Problem(
            f"{found.shown} is cut off: {content.fault_message}{found.count}",
            at=found,
            fold=facts.files.alike(field),
            suggestion="write it again, or copy it again; look for a full disk",
        )
