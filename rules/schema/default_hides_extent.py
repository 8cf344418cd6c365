"""SCH017: a default must not hide the animation of an extent that it does not enclose."""

from usdvol_lint.rule import INFO, Facts, Prim, Problem, Problems, layered, rule

_SLACK = 1e-5
_HALF_SLACK = 2**-10
_CLAMP = 50_000.0


@rule("SCH017", on=("Volume", "ParticleField"), when=layered(), severity=INFO, since="0.1")
def default_hides_extent(prim: Prim, facts: Facts) -> Problems:
    if facts.layers.may_lack_values(prim):
        return
    hidden = facts.prims.hidden_boxes_outside(prim, _SLACK)
    if hidden and not _is_told_of(prim, facts):
        yield Problem(
            f"the default of 'extent' holds at all times and hides {hidden.words}, which it does not enclose",
            at=prim.GetAttribute("extent"),
            suggestion="author time samples in its place, or remove it",
        )


def _is_told_of(prim: Prim, facts: Facts) -> bool:
    """Whether VOL013 or ARR013 finds the extent too small."""
    if facts.prims.is_a(prim, "Volume"):
        return facts.tells("VOL013") and facts.volumes.shortfall(prim, _SLACK) is not None
    if not facts.tells("ARR013"):
        return False
    return facts.particles.positions_outside_extent(prim, _SLACK, _HALF_SLACK, _CLAMP) is not None
