"""STG006: what layers say of prims below an instance reaches nothing."""

from typing import Any

from usdvol_lint.rule import STAGE, WARNING, Facts, Prim, Problem, Problems, rule


@rule("STG006", on=STAGE, severity=WARNING, since="0.1")
def override_ignored(stage: Prim, facts: Facts) -> Problems:
    for instance, overrides in facts.layers.lost_overrides:
        if facts.layers.may_lack_values(instance):
            continue
        for path, at, spec in overrides:
            below = path.MakeRelativePath(instance.GetPath())
            shown = [f"<{facts.prims.shown_path(each)}>" for each in _instances(path, stage.GetStage())]
            yield Problem(
                f"{shown[0]} is an instance, so what is said below it is ignored: {str(below)!r}",
                at=at,
                spec=spec,
                against=[(instance, "instanceable")],
                subject="instanceable",
                fold=shown[0],
                suggestion=f"say 'instanceable = false' on {' and '.join(shown)}",
            )


def _instances(path: Any, stage: Any) -> list[Prim]:
    """The instances above the prim that a path leads to, from the outermost down."""
    prims = map(stage.GetPrimAtPath, path.GetPrimPath().GetParentPath().GetPrefixes())
    return [prim for prim in prims if prim and prim.IsInstance()]
