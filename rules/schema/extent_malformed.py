"""SCH008: an extent is two corners of finite numbers, the lower one first."""

from operator import le
from typing import Any

from usdvol_lint.rule import ERROR, Facts, Prim, Prims, Problem, Problems, When, rule

_CORNERS = "author two corners, the lower one first: [(xmin, ymin, zmin), (xmax, ymax, zmax)]"
_EACH = "author the lesser number of each axis in the first corner, and the greater one in the second"
_MALFORMED = When(Prims.have_malformed_extents, bool)


@rule("SCH008", on=("Volume", "ParticleField"), when=_MALFORMED, severity=ERROR, since="0.1")
def extent_malformed(prim: Prim, facts: Facts) -> Problems:
    extents = facts.prims.extents(prim)
    for fault, held in extents.grouped(_fault):
        first = next(iter(held))
        corners = f": {first.low}, {first.high}" if first.size == 2 else ""
        positions = facts.particles.arrays(prim).used("positions")
        is_spoilt = not first.is_finite and any(array.spoils(extents) for array in positions)
        if not (is_spoilt and facts.tells("ARR007")):
            yield Problem(f"extent {fault}{corners}{held.count}", at=held, suggestion=_remedy(prim, facts, held))


def _fault(extent: Any) -> str | None:
    size, low, high = extent
    if size != 2:
        return f"has {size} {'element' if size == 1 else 'elements'}, not two"
    if not extent.is_finite:
        return "is not finite"
    if all(map(le, low, high)) or extent.is_empty_range:
        return None
    return "has a minimum above its maximum"


def _remedy(prim: Prim, facts: Facts, held: Any) -> str:
    first, *more = held
    is_volume = facts.prims.is_a(prim, "Volume")
    if is_volume and (box := facts.volumes.fitting_extent(prim)):
        return f"write '{box}'" + " in the place of the time samples" * bool(held.total)
    if first.size == 2 and first.is_finite and first.in_order:
        return _EACH if more else f"write '{first.in_order}'"
    positions = None if is_volume else next(facts.particles.arrays(prim).used("positions"), None)
    span = positions.shown_span if positions else ""
    return f"the positions span {span}: author at least that" if span else _CORNERS
