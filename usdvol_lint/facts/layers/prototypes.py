"""Targets of PointInstancers that are not there, and that were probably something of ours."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np
from pxr import Usd, UsdGeom

from usdvol_lint import schema
from usdvol_lint.facts.layers.words import speak_of_ours
from usdvol_lint.facts.usd.below import each_below
from usdvol_lint.facts.usd.calls import COMPOSED, get_children, get_path
from usdvol_lint.facts.usd.drawn import Drawn
from usdvol_lint.facts.usd.instances import shown_path
from usdvol_lint.facts.usd.kinds import PrimKinds
from usdvol_lint.nearest import is_one_slip_from


class LostPrototype(NamedTuple):
    """A target of a PointInstancer at which there is no prim.

    `number` is its place among the targets, from 0 on.
    `similar` is the path that was probably meant, to a prim that is or holds one of ours.
    """

    relationship: Any
    number: int
    target: str
    similar: str | None


def lost_prototypes(
    stage: Any, drawn: Drawn, kinds: PrimKinds, may_lack: Callable[[Any], bool]
) -> Iterator[LostPrototype]:
    """The targets that are not there, where what was meant is ours, or names speak of us."""
    for instancer in sorted(drawn.live_instancers, key=get_path):
        relationship = instancer.GetRelationship("prototypes")
        for index, target in enumerate(relationship.GetForwardedTargets()):
            path = target.GetPrimPath()
            if stage.GetPrimAtPath(path) or not _may_be_used(instancer, index):
                continue
            above = _nearest(stage, path)
            if not COMPOSED(above) or may_lack(above):
                continue
            similar = _similar(above, path, kinds)
            if similar or speak_of_ours([str(path)]):
                shown = similar and shown_path(stage, similar)
                yield LostPrototype(relationship, index, shown_path(stage, path), shown)


def _may_be_used(instancer: Any, index: int) -> bool:
    """Whether an instance that is drawn may have the prototype with this index."""
    indices = instancer.GetAttribute("protoIndices")
    if not indices or indices.GetNumTimeSamples():
        return bool(indices)
    uses = np.atleast_1d(np.asarray(indices.Get() or ()) == index)
    hidden = instancer.GetAttribute("invisibleIds")
    if not hidden.GetNumTimeSamples():
        mask = UsdGeom.PointInstancer(instancer).ComputeMaskAtTime(Usd.TimeCode.Default())
        uses = uses[np.asarray(mask, dtype=bool)] if len(mask) == len(uses) else uses
    return bool(uses.any())


def _nearest(stage: Any, path: Any) -> Any:
    while not (prim := stage.GetPrimAtPath(path)):
        path = path.GetParentPath()
    return prim


def _similar(above: Any, path: Any, kinds: PrimKinds) -> Any | None:
    """The path with one name of a child for one that is nearly the same, if that leads to ours."""
    missing = path.GetPrefixes()[above.GetPath().pathElementCount]
    found = [
        meant
        for child in get_children(above, Usd.TraverseInstanceProxies(COMPOSED))
        if is_one_slip_from(missing.name, child.GetName())
        and _shows_ours(above, meant := path.ReplacePrefix(missing, child.GetPath()), kinds)
    ]
    return found[0] if len(found) == 1 else None


def _shows_ours(above: Any, path: Any, kinds: PrimKinds) -> bool:
    prim = above.GetStage().GetPrimAtPath(path)
    below = each_below(prim) if prim else ()
    return any(not schema.OURS.isdisjoint(kinds.names(kinds.key(each))) for each in below)
