"""AST017: where a sequence lies on disk, a field should not show one frame of it at all times."""

from usdvol_lint.rule import INFO, WARNING, Facts, PathMark, Prim, Problem, Problems, file_paths, frame_ranges, rule

_ONE_FRAME = file_paths(PathMark.NUMBERED, PathMark.SEVERAL)


@rule("AST017", on="FieldAsset", when=_ONE_FRAME, severity=WARNING, since="0.1")
def stands_still(field: Prim, facts: Facts) -> Problems:
    time_range = facts.layers.time_range
    still = facts.files.still(field, time_range)
    if still is None or facts.layers.may_lack_values(field, "filePath"):
        return
    staging = facts.volumes.staging(field, time_range) if time_range and not still.is_sampled else None
    if staging and not staging.is_shown:
        return
    held_in = None if still.is_sampled else time_range
    is_staged = staging and still.by_range and not staging.is_still
    there = f"the files {frame_ranges(still.numbers)} lie beside it" if still.numbers else ""
    if still.is_lost:
        message = f"all samples name {still.affected.shown}, which lacks its frame number"
        message += f": {there}" * bool(there)
    elif still.is_sampled:
        message = f"all samples name {still.affected.shown}, though {there}"
    else:
        message = f"{still.affected.shown} is held at all times, though {there}"
        message += f" and {time_range.words}" if time_range else ""
    yield Problem(
        message,
        at=still.affected,
        spec=held_in and held_in.meeting_value(still.affected),
        fold=facts.files.alike(field),
        suggestion=still.advice,
        severity=None if still.is_certain and not is_staged else INFO,
    )
