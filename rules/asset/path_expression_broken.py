"""AST004: a variable expression must evaluate to a path."""

from usdvol_lint.rule import ERROR, WARNING, AssetState, Facts, Prim, Problem, Problems, file_paths, quoted, rule

_ADVICE = 'correct it, as in @`"./${NAME}.vdb"`@, or write a path without backticks'


@rule(
    "AST004",
    on="FieldAsset",
    when=file_paths(AssetState.BROKEN_EXPRESSION, AssetState.UNSET_VARIABLE),
    severity=ERROR,
    since="0.1",
)
def path_expression_broken(field: Prim, facts: Facts) -> Problems:
    paths = facts.files.paths(field)
    for broken in paths.by_detail(AssetState.BROKEN_EXPRESSION):
        reason = broken.first.detail[:1].lower() + broken.first.detail[1:]
        yield Problem(
            f"the expression {quoted(broken.first.authored)} can't be evaluated: {reason}{broken.count}",
            at=broken,
            suggestion=_ADVICE,
        )
    for unset in paths.by_detail(AssetState.UNSET_VARIABLE):
        variables = unset.first.detail
        yield Problem(
            f"the expression {quoted(unset.first.authored)} needs a variable that is not set: {variables}{unset.count}",
            at=unset,
            suggestion=f"set {variables} in expressionVariables of the root layer; USD does not "
            "read those of sublayers",
            severity=WARNING,
        )
