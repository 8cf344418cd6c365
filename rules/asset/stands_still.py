"""AST017: where a sequence lies on disk, a field should not show one frame of it at all times."""

from usdvol_lint.rule import (
    INFO,
    WARNING,
    Facts,
    PathMark,
    Prim,
    Problem,
    Problems,
    file_paths,
    format_time,
    frame_ranges,
    rule,
)

_ONE_FRAME = file_paths(PathMark.NUMBERED, PathMark.SEVERAL)


@rule("AST017", on="FieldAsset", when=_ONE_FRAME, severity=WARNING, since="0.1")
def stands_still(field: Prim, facts: Facts) -> Problems:
    time_range = facts.layers.time_range
    still = facts.files.still(field, time_range)
    if still is None or facts.layers.may_lack_values(field):
        return
    staging = facts.volumes.staging(field, time_range) if time_range and not still.is_sampled else None
    if staging and not staging.is_shown:
        return
    is_staged = staging and still.by_range and not staging.is_still
    affected = still.affected
    there = f"the files {frame_ranges(still.numbers)} lie beside it" if still.numbers else ""
    if still.is_lost:
        message = f"all samples name {affected.shown}, which lacks its frame number"
        message += f": {there}" if there else ""
    elif still.is_sampled:
        message = f"all samples name {affected.shown}, though {there}"
    else:
        start, end = map(format_time, time_range or ())
        message = f"{affected.shown} is held at all times, though {there} and the stage's range is {start}-{end}"
    yield Problem(
        message,
        at=affected,
        suggestion=still.advice,
        severity=None if still.is_certain and not is_staged else INFO,
    )
