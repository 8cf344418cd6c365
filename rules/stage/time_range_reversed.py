"""STG007: a time range begins before it ends."""

from usdvol_lint.rule import OURS, STAGE, WARNING, Facts, Prim, Problem, Problems, format_time, rule


@rule("STG007", on=STAGE, severity=WARNING, since="0.1")
def time_range_reversed(root: Prim, facts: Facts) -> Problems:
    authored = facts.layers.authored_time_range
    if authored and authored[0] > authored[1] and any(map(facts.prims.of, OURS)):
        start, end = map(format_time, authored)
        yield Problem(
            f"startTimeCode {start} is after endTimeCode {end}, so the stage has no frames",
            at=root,
            suggestion=f"say 'startTimeCode = {end}' and 'endTimeCode = {start}'",
        )
