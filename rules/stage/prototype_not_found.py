"""STG012: what a PointInstancer draws must be there."""

from usdvol_lint.rule import INFO, STAGE, WARNING, Facts, Prim, Problem, Problems, rule


@rule("STG012", on=STAGE, severity=WARNING, since="0.1")
def prototype_not_found(root: Prim, facts: Facts) -> Problems:
    for relationship, number, target, similar in facts.layers.lost_prototypes:
        yield Problem(
            f"there is no prim <{target}>, so the instances with index {number} draw nothing",
            at=relationship,
            subject=target.rpartition("/")[2],
            severity=None if similar else INFO,
            suggestion=f"did you mean <{similar}>?" if similar else "name a prim that is there, or define this one",
        )
