"""What PointInstancers draw though no traversal of USD visits it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import chain
from typing import Any

from pxr import Usd

from usdvol_lint import schema
from usdvol_lint.facts.usd.calls import DRAWN_BELOW, is_defined
from usdvol_lint.facts.usd.instances import in_prototype
from usdvol_lint.facts.usd.kinds import PrimKinds


def undefined_prototypes(instancers: Iterable[Any], kinds: PrimKinds) -> Iterator[list[Any]]:
    """The prototypes of PointInstancers that nothing defines, each as its prims, the root first.

    Those of the instancers in them follow.
    """
    waiting = list(instancers)
    drawn: set[Any] = set()
    while waiting:
        instancer = waiting.pop()
        for path in instancer.GetRelationship("prototypes").GetForwardedTargets():
            target = instancer.GetStage().GetPrimAtPath(path.GetPrimPath())
            root = in_prototype(target) if target else None
            if not root or root in drawn or is_defined(root) or not DRAWN_BELOW(root):
                continue
            prims = list(Usd.PrimRange(root, DRAWN_BELOW))
            drawn.update(prims)
            yield prims
            waiting += (prim for prim in prims if kinds.is_a(prim, schema.POINT_INSTANCER))


def moved_prototypes(instancers: Iterable[Any]) -> frozenset[Any]:
    """The paths of the prototypes that PointInstancers show at changing places."""
    moving = (each for each in instancers if _is_moving(each.GetAttribute("positions")))
    targets = (each.GetRelationship("prototypes").GetForwardedTargets() for each in moving)
    return frozenset(chain.from_iterable(targets))


def _is_moving(positions: Any) -> bool:
    return bool(positions and positions.ValueMightBeTimeVarying())
