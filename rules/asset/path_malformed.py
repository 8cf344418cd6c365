"""AST008: a path must be written so that every platform reads it alike."""

import re
from collections.abc import Iterator

from usdvol_lint.rule import WARNING, AssetSample, Facts, PathMark, Prim, Problem, Problems, file_paths, quoted, rule

_SUSPECT = re.compile(r"[A-Za-z]:|~|\s|[^\\]*+(?:\\|(?<=\s)\Z)")
_HOME = re.compile(r"~[^/\\]*[/\\]")
_ROOT = re.compile(r"[A-Za-z]:|\\\\")


@rule("AST008", on="FieldAsset", when=file_paths(PathMark.UNPLAIN), severity=WARNING, since="0.1")
def path_malformed(field: Prim, facts: Facts) -> Problems:
    paths = facts.files.paths(field)
    suspect = paths.matching(_SUSPECT)
    malformed = suspect and paths.affected(sample for sample in suspect.samples if any(_defects(sample)))
    if malformed:
        defects = ", and ".join(_defects(malformed.first))
        yield Problem(
            f"{malformed.shown} {defects}{malformed.count}",
            at=malformed,
            suggestion=_advice(malformed.first.path),
        )


def _defects(sample: AssetSample) -> Iterator[str]:
    path = sample.path
    if path[1:2] == ":" and path[0].isalpha():
        yield "begins with a drive letter, which only Windows has"
    if _HOME.match(path) and not sample.is_there:  # a file may well be called so
        yield "begins with '~', which USD does not expand"
    if "\\" in path:
        yield "has backslashes, which separate names on Windows alone"
    if path != path.strip():
        yield "begins or ends with a blank"


def _advice(path: str) -> str:
    if _ROOT.match(path) or _HOME.match(path):
        return "name it in relation to the layer, with '/' between names"
    corrected = re.sub(r"\\+", "/", path.strip())
    return f"write it as {quoted(corrected)}"
