"""VOL013: the extent of a Volume must enclose the grids that its fields name."""

from usdvol_lint.rule import ERROR, INFO, Facts, NotChecked, Prim, Problem, Problems, Volumes, When, rule

_ALIGN = "move the field below the Volume, or give both the same transform"


def _sticks_out(overhang: float, relative_slack: float) -> bool:
    return overhang > relative_slack


@rule("VOL013", on="Volume", when=When(Volumes.overhangs, _sticks_out), severity=ERROR, since="0.1")
def extent_too_small(volume: Prim, facts: Facts, *, relative_slack: float = 1e-5) -> Problems:
    found = facts.volumes.shortfall(volume, relative_slack)
    if found:
        grid = found.worst.shown
        reach = f"{grid} may be cut off where it reaches out of the extent,"
        cut = f"the extent encloses the voxel centres of {grid} and cuts voxels off"
        nothing = f"the extent is the empty range, and {grid} has voxels"
        missed = cut if found.only_half_voxels else reach
        yield Problem(
            (nothing if found.is_of_empty_extent else f"{missed} by {found.worst.amounts}") + found.count,
            at=found,
            against=[*found.against, *facts.volumes.bindings(volume).properties_of(found.fields)],
            suggestion=_ALIGN if facts.volumes.are_apart(volume, found.fields) else found.remedy,
            severity=INFO if found.only_half_voxels else None,
        )
    if unmeasured := facts.volumes.unmeasured_grids(volume):
        yield NotChecked(
            f"the extent was not compared with {unmeasured.shown}: "
            f"the file does not tell where its voxels are{unmeasured.count}",
            at=unmeasured,
        )
