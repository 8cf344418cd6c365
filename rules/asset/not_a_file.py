"""AST005: what a field names must be a file with content that can be read."""

from usdvol_lint.rule import ERROR, AssetState, Facts, FileFault, Prim, Problem, Problems, file_paths, rule

_ADVICE = {
    FileFault.FOLDER: "name a file in it",
    FileFault.EMPTY: "write it again: this is what a simulation that died leaves behind",
    FileFault.UNREADABLE: "check its permissions",
    FileFault.PACKED: "store it in the package as it is",
    FileFault.LFS_POINTER: "run `git lfs pull`",
}


@rule("AST005", on="FieldAsset", when=file_paths(AssetState.NOT_A_FILE), severity=ERROR, since="0.1")
def not_a_file(field: Prim, facts: Facts) -> Problems:
    for found in facts.files.paths(field).by_detail(AssetState.NOT_A_FILE):
        fault = FileFault(found.first.detail)
        message = f"{found.shown} is {fault}{found.count}"
        yield Problem(
            message, at=found, suggestion=_ADVICE.get(fault), subject=fault.name, fold=facts.files.alike(field)
        )
