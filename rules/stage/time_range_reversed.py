"""STG007: a time range begins before it ends."""

from usdvol_lint.rule import OURS, STAGE, WARNING, Facts, Prim, Problem, Problems, format_time, rule


@rule("STG007", on=STAGE, severity=WARNING, since="0.1")
def time_range_reversed(root: Prim, facts: Facts) -> Problems:
    authored = facts.layers.authored_time_range
    if authored and authored[0] > authored[1] and any(map(facts.prims.of, OURS)):
        start, end = map(format_time, authored)
        first, last = map(format_time, _meant(*authored, facts.prims.animated_times()))
        is_swapped = (first, last) == (end, start)
        yield Problem(
            f"startTimeCode {start} is after endTimeCode {end}, so the stage has no frames",
            at=root,
            suggestion=f"say 'startTimeCode = {first}' and 'endTimeCode = {last}'"
            f"{'' if is_swapped else ', the first and the last time with a sample'}",
        )


def _meant(start: float, end: float, times: list[float]) -> tuple[float, float]:
    """The range as swapped, or that of the time samples if most of them lie outside of it."""
    within = [time for time in times if end <= time <= start]
    return (end, start) if 2 * len(within) >= len(times) else (times[0], times[-1])
