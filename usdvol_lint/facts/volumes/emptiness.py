"""Why a relationship has no target: read from its specs, which composition merged."""

from __future__ import annotations

from typing import Any, TypeAlias

from pxr import Sdf

from usdvol_lint.facts.volumes.states import Emptiness

Reason: TypeAlias = tuple[Emptiness, tuple[Any, ...]]


def why_empty(relationship: Any, known: dict[Any, Reason]) -> Reason:
    """Why a relationship has no forwarded target, and the specs whose targets were lost.

    Of one that forwards to another, the emptiness of that is the reason.  Those on the way are
    added to `known`, by path: many may lead into one chain or ring.
    """
    stage = relationship.GetStage()
    passed: dict[Any, None] = {}
    while True:
        path = relationship.GetPath()
        if path in known or path in passed:
            reason = known.get(path, (Emptiness.CIRCULAR, ()))
            break
        passed[path] = None
        targets = relationship.GetTargets()
        following = stage.GetRelationshipAtPath(targets[0]) if targets else None
        if not following:
            reason = (Emptiness.UNAUTHORED, ()) if targets else _own_reason(relationship)
            break
        relationship = following
    known.update(dict.fromkeys(passed, reason))
    return reason


def _own_reason(relationship: Any) -> Reason:
    """Reads the list operations of the specs, strongest first."""
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
