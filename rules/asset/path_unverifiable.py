"""AST010: a path that nothing here resolves can't be checked, or not rendered elsewhere."""

from usdvol_lint.rule import ERROR, INFO, WARNING, AssetState, Facts, Prim, Problem, Problems, file_paths, rule


@rule(
    "AST010",
    on="FieldAsset",
    when=file_paths(AssetState.LIVE_SESSION, AssetState.UNVERIFIABLE),
    severity=ERROR,
    since="0.1",
)
def path_unverifiable(field: Prim, facts: Facts) -> Problems:
    paths, alike = facts.files.paths(field), facts.files.alike(field)
    for live in paths.by_detail(AssetState.LIVE_SESSION):
        yield Problem(
            f"{live.shown} exists in a running Houdini session alone{live.count}",
            at=live,
            fold=alike,
            suggestion="save the volume to a .vdb file and name that",
        )
    for found in paths.by_detail(AssetState.UNVERIFIABLE):
        if found.first.detail.lower() == "file":
            yield Problem(
                f"{found.shown} is not found: USD's own resolver does not know 'file:'{found.count}",
                at=found,
                severity=WARNING,
                fold=alike,
                suggestion="write the path without 'file://'",
            )
            continue
        query = found.first.path.partition("?")[2]
        why = f"no resolver here answers for '{found.first.detail}:'"
        if found.first.detail == "?":
            why = f"the file is there, and no resolver here reads '?{query}'"
        yield Problem(
            f"{found.shown} was not checked: {why}{found.count}",
            at=found,
            severity=INFO,
            machine=None if found.first.detail == "?" else f"a resolver for '{found.first.detail}:'",
            fold=alike,
            suggestion="check the stage where the resolver that it needs is installed",
        )
