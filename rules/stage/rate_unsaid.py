"""STG008: a layer with animation should say its rate where the stage's is not 24."""

from usdvol_lint.rule import STAGE, WARNING, Facts, Prim, Problem, Problems, format_time, rule


@rule("STG008", on=STAGE, severity=WARNING, since="0.1")
def rate_unsaid(root: Prim, facts: Facts) -> Problems:
    for unsaid in facts.layers.unsaid_rates:
        displaced = unsaid.displaced[0]
        others = len(unsaid.displaced) - 1
        more = f" (and those of {others} other attribute{'s' * (others > 1)})" if others else ""
        where = "between frames" if displaced.are_between else "outside of the stage's time range"
        yield Problem(
            "the layer says no timeCodesPerSecond, so USD takes its rate for 24 and scales its "
            f"times by {format_time(unsaid.scale)} on this stage of {format_time(unsaid.rate)}: "
            f"{len(displaced.times)} of {displaced.total} samples land {where}{more}",
            at=displaced,
            spec=unsaid.blamed,
            subject=unsaid.layer.GetDisplayName(),
            suggestion=f"write the rate of its samples into it, such as 'timeCodesPerSecond = {format_time(unsaid.rate)}'",
        )
