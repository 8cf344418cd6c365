"""GRD002: a file must be as long as it says."""

from usdvol_lint.rule import ERROR, Content, Facts, Prim, Problem, Problems, contents, rule


def _cut(content: Content) -> object:
    code = content.fault and content.fault.code
    return code if code == "truncated" else None


@rule("GRD002", on="FieldAsset", when=contents(_cut), severity=ERROR, since="0.1")
def file_truncated(field: Prim, facts: Facts) -> Problems:
    for content, found in facts.contents(field).grouped(_cut):
        yield Problem(
            f"{found.shown} is cut off: {content.fault.message}{found.count}",
            at=found.attribute,
            times=found.times,
            at_default=found.at_default,
            asset=found.first.authored,
            suggestion="write it again, or copy it again; look for a full disk",
        )
