"""AST008: a path must be written so that every platform reads it alike."""

import re
from collections.abc import Iterator

from usdvol_lint.rule import (
    WARNING,
    AssetState,
    Facts,
    PathMark,
    Prim,
    Problem,
    Problems,
    file_paths,
    quoted,
    rule,
)

_STATES = (AssetState.FILE, AssetState.MISSING, AssetState.NOT_A_FILE, AssetState.PATTERN)
_SUSPECT = re.compile(r"[A-Za-z]:|~|\s|[^\\]*+(?:\\|(?<=\s)\Z)")
_HOME = re.compile(r"~[^/\\]*[/\\]")
_ROOT = re.compile(r"[A-Za-z]:|\\\\")


@rule("AST008", on="FieldAsset", when=file_paths(PathMark.UNPLAIN), severity=WARNING, since="0.1")
def path_malformed(field: Prim, facts: Facts) -> Problems:
    paths = facts.assets(field, "filePath")
    suspect = paths.matching(_SUSPECT, *_STATES)
    if suspect is None:
        return
    # A file may well be called '~x', and is if it is there.
    malformed = paths.affected(
        sample
        for sample in suspect.samples
        if any(_defects(sample.path, sample.state is AssetState.FILE))
    )
    if malformed:
        path = malformed.first.path
        defects = _defects(path, malformed.first.state is AssetState.FILE)
        yield Problem(
            f"{malformed.shown} {', and '.join(defects)}{malformed.count}",
            at=malformed.attribute,
            times=malformed.times,
            at_default=malformed.at_default,
            asset=malformed.first.authored,
            suggestion=_advice(path),
        )


def _defects(path: str, is_there: bool) -> Iterator[str]:
    if path[1:2] == ":" and path[0].isalpha():
        yield "begins with a drive letter, which only Windows has"
    if _HOME.match(path) and not is_there:
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
