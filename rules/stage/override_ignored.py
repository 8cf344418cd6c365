"""STG006: what layers say of prims below an instance reaches nothing."""

from usdvol_lint.rule import STAGE, WARNING, Facts, Prim, Problem, Problems, rule


@rule("STG006", on=STAGE, severity=WARNING, since="0.1")
def override_ignored(stage: Prim, facts: Facts) -> Problems:
    for instance, overrides in facts.layers.lost_overrides:
        if facts.layers.may_lack_values(instance):
            continue
        changed, spec = overrides[0]
        below = changed.GetPath().MakeRelativePath(instance.GetPath())
        more = f" and {len(overrides) - 1} more" if len(overrides) > 1 else ""
        shown = [f"<{facts.prims.shown_path(each)}>" for each in _instances(changed, instance)]
        yield Problem(
            f"{shown[0]} is an instance, so what is said below it is ignored: {str(below)!r}{more}",
            at=changed,
            spec=spec,
            suggestion=f"say 'instanceable = false' on {' and '.join(shown)}",
        )


def _instances(changed: Prim, outermost: Prim) -> list[Prim]:
    """The instances above a property, from the outermost down."""
    found = []
    prim = changed.GetPrim()
    while prim != outermost:
        prim = prim.GetParent()
        if prim.IsInstance():
            found.append(prim)
    return found[::-1]
