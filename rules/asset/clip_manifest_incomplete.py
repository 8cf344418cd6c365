"""AST014: the manifest of value clips must declare what the clips hold."""

from usdvol_lint.rule import ERROR, Facts, PathMark, Prim, Problem, Problems, file_paths, quoted, rule


@rule("AST014", on="FieldAsset", when=file_paths(PathMark.CLIPPED), severity=ERROR, since="0.1")
def clip_manifest_incomplete(field: Prim, facts: Facts) -> Problems:
    unlisted = facts.files.unlisted_clips(field)
    if unlisted:
        yield Problem(
            f"the clip {quoted(unlisted.clip)} holds filePath, but the manifest "
            f"{quoted(unlisted.manifest)} does not declare it: USD ignores the clips",
            at=field.GetAttribute("filePath"),
            spec=unlisted.spec,
            asset=unlisted.manifest_path,
            suggestion="write the manifest again, or remove manifestAssetPath: USD then makes one",
        )
