"""GRD013: the files of a sequence should hold the same grids."""

from usdvol_lint.rule import INFO, WARNING, Facts, Grids, Prim, Problem, Problems, When, rule

_DIFFER = When(Grids.content_classes, lambda classes: len(classes) > 1)


@rule("GRD013", on="FieldAsset", when=_DIFFER, severity=WARNING, since="0.1")
def grids_change(field: Prim, facts: Facts) -> Problems:
    changes = facts.grids.changes(field)
    if changes:
        affected = changes.affected
        yield Problem(
            f"{affected.shown} {changes.difference}, unlike most of the sequence{affected.count}",
            at=affected,
            suggestion="look at their dates: frames that are left over from another export have to be exported again",
            severity=None if changes.is_asked_for else INFO,
        )
