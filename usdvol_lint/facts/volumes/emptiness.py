"""Why a relationship has no target: read from its specs, which composition merged."""

from __future__ import annotations

from typing import Any

from pxr import Sdf

from usdvol_lint.facts.volumes.states import Emptiness


def why_empty(relationship: Any) -> tuple[Emptiness, tuple[Any, ...]]:
    """Why a relationship has no forwarded target, and the specs whose targets were lost.

    Reads the list operations of the specs, strongest first.
    """
    seen = set()
    while targets := relationship.GetTargets():
        # It forwards to another relationship, whose emptiness is the reason.
        seen.add(relationship.GetPath())
        relationship = relationship.GetStage().GetRelationshipAtPath(targets[0])
        if not relationship:
            return Emptiness.UNAUTHORED, ()
        if relationship.GetPath() in seen:
            return Emptiness.CIRCULAR, ()
    lost: list[Any] = []
    emptiness = Emptiness.UNAUTHORED
    deleted: set[str] = set()
    specs = relationship.GetPropertyStack()  # weaker ones may be of an attribute
    for spec in (spec for spec in specs if isinstance(spec, Sdf.RelationshipSpec)):
        targets = spec.targetPathList
        deleted.update(path.name for path in targets.deletedItems)
        added = [path for path in targets.GetAddedOrExplicitItems() if path.name not in deleted]
        if added:
            lost.append(spec)
        elif targets.GetAddedOrExplicitItems():
            emptiness = Emptiness.DELETED
        if targets.isExplicit:
            if emptiness is Emptiness.UNAUTHORED:
                emptiness = Emptiness.BLOCKED
            break
    return (Emptiness.LOST, tuple(lost)) if lost else (emptiness, ())
