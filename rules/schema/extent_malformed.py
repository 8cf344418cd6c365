"""SCH008: an extent is two corners of finite numbers, the lower one first."""

from math import isfinite
from operator import le
from typing import Any

from usdvol_lint.rule import ERROR, Facts, Prim, Prims, Problem, Problems, When, rule


@rule(
    "SCH008",
    on=("Volume", "ParticleField"),
    when=When(Prims.have_malformed_extents, bool),
    severity=ERROR,
    since="0.1",
)
def extent_malformed(prim: Prim, facts: Facts) -> Problems:
    for fault, held in facts.prims.extents(prim).grouped(_fault):
        first = next(iter(held))
        corners = f": {first.low}, {first.high}" if first.size == 2 else ""
        yield Problem(
            f"extent {fault}{corners}{held.count}",
            at=held,
            suggestion="author the lower corner, then the upper one: [(0, 0, 0), (1, 1, 1)]",
        )


def _fault(extent: Any) -> str | None:
    size, low, high = extent
    if size != 2:
        return f"has {size} {'element' if size == 1 else 'elements'}, not two"
    if not all(map(isfinite, low + high)):
        return "is not finite"
    if all(map(le, low, high)) or extent.is_empty_range:
        return None
    return "has a minimum above its maximum"
