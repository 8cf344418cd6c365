"""SCH015: a transform needs ops that are there, and numbers that are finite."""

from usdvol_lint.rule import OURS, STAGE, WARNING, Facts, Prim, Problem, Problems, authored, rule


@rule("SCH015", on=(*OURS, STAGE), when=authored("xformOpOrder"), severity=WARNING, since="0.1")
def transform_broken(prim: Prim, facts: Facts) -> Problems:
    for each in facts.prims.above_ours if prim.IsPseudoRoot() else (prim,):
        problems = list(_of_prim(each, facts))
        if problems and (each == prim or facts.prims.is_handed_down(each, "xformOpOrder")):
            yield from problems


def _of_prim(prim: Prim, facts: Facts) -> Problems:
    missing, not_finite = facts.prims.transform_faults(prim)
    if missing and not facts.layers.may_lack_values(prim):
        for order, name, intended, is_there in missing:
            why = "which is no op of UsdGeom" if is_there else "which is not there"
            yield Problem(
                f"xformOpOrder names {name!r}, {why}, so USD leaves it out",
                at=order,
                subject=name,
                suggestion=f"did you mean {intended!r}?"
                if intended
                else "take the name out of xformOpOrder, or use an op that UsdGeom has"
                if is_there
                else f"author {name!r}, or take the name out of xformOpOrder",
            )
    for values in not_finite:
        name = values.attribute.GetName()
        yield Problem(
            f"{name!r} is not finite: {next(iter(values))}{values.count}",
            at=values,
            suggestion="author finite numbers, or export it again",
        )
