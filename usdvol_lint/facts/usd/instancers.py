"""What PointInstancers show at changing places."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import chain
from typing import Any


def moved_prototypes(instancers: Iterable[Any]) -> frozenset[Any]:
    """The paths of the prototypes that PointInstancers show at changing places."""
    moving = (each for each in instancers if _is_moving(each.GetAttribute("positions")))
    targets = (each.GetRelationship("prototypes").GetForwardedTargets() for each in moving)
    return frozenset(chain.from_iterable(targets))


def _is_moving(positions: Any) -> bool:
    return bool(positions and positions.ValueMightBeTimeVarying())
