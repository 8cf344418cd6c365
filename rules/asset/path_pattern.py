"""AST003: a path must not hold a placeholder, which USD does not replace."""

from collections.abc import Sequence

from usdvol_lint.rule import ERROR, AssetState, Facts, Prim, Problem, Problems, file_paths, rule

_MOST = 1000


@rule("AST003", on="FieldAsset", when=file_paths(AssetState.PATTERN), severity=ERROR, since="0.1")
def path_pattern(field: Prim, facts: Facts) -> Problems:
    for found in facts.files.paths(field).by_detail(AssetState.PATTERN):
        frames = facts.files.frames(found)
        yield Problem(
            f"no file at {found.shown}: USD does not replace '{found.first.detail}'{found.count}",
            at=found,
            fold=facts.files.alike(field),
            suggestion=_time_samples(frames) if frames else _advice(found.as_expression, found.has_frame),
        )


def _advice(expression: str | None, has_frame: bool) -> str:
    each = ", in a time sample for each frame instead of the placeholder" if has_frame else ""
    if expression:
        return (
            "USD reads no environment variables: write the path out, or set them in expressionVariables, "
            f"as USD replaces variables in an expression alone: @{expression}@{each}"
        )
    return "name one file, or author a time sample for each frame"


def _time_samples(frames: Sequence[tuple[int, str]]) -> str:
    """The files that are there, as text to paste."""
    samples = ", ".join(f"{number}: @{path}@" for number, path in frames[:_MOST])
    samples += ", …" if len(frames) > _MOST else ""
    files = f"{len(frames)} files" if len(frames) > 1 else "1 file"
    return f"{files} found: author filePath.timeSamples = {{ {samples} }}"
