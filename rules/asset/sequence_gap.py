"""AST011: a run of samples should have no holes."""

from usdvol_lint.rule import WARNING, Facts, PathMark, Prim, Problem, Problems, file_paths, frame_ranges, rule


@rule("AST011", on="FieldAsset", when=file_paths(PathMark.SEVERAL), severity=WARNING, since="0.1")
def sequence_gap(field: Prim, facts: Facts) -> Problems:
    missing = facts.files.missing_samples(field)
    if missing:
        samples = "no sample" if len(missing.times) == 1 else "no samples"
        yield Problem(
            f"{samples} at {frame_ranges(missing.times)}, in a run that is regular otherwise "
            f"({len(missing.times)} missing, {missing.present} there)",
            at=field.GetAttribute("filePath"),
            times=missing.times,
            fold=facts.files.alike(field),
            asset=missing.before.authored,
            suggestion=missing.advice,
        )
