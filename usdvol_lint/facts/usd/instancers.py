"""What PointInstancers show at changing places."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import chain
from typing import Any

_PLACES = ("positions", "orientations", "orientationsf", "scales")


def moved_prototypes(instancers: Iterable[Any]) -> frozenset[Any]:
    """The paths of the prototypes that PointInstancers show at changing places."""
    moving = (each for each in instancers if any(_varies(each, name) for name in _PLACES))
    targets = (each.GetRelationship("prototypes").GetForwardedTargets() for each in moving)
    return frozenset(chain.from_iterable(targets))


def _varies(prim: Any, name: str) -> bool:
    attribute = prim.GetAttribute(name)
    return bool(attribute and attribute.ValueMightBeTimeVarying())
