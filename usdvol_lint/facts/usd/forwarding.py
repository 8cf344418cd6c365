"""Targets of relationships behind those that they forward to, in chains of any length."""

from __future__ import annotations

from typing import Any

from usdvol_lint.facts.usd.calls import get_targets, own_targets


class Forwarding:
    """Follows relationships that lead to one other each; where a chain ends is found once.

    USD follows each of them anew, and many may lead into one chain.
    """

    def __init__(self) -> None:
        self._ends: dict[Any, Any] = {}
        self._targets: dict[Any, list[Any]] = {}

    def targets(self, relationship: Any) -> list[Any]:
        """What USD calls the forwarded targets."""
        own = own_targets(relationship)
        if len(own) == 1 and own[0].IsPrimPath():
            return list(own)  # nearly always
        end = self._end(relationship)
        path = end.GetPath()
        if path not in self._targets:
            self._targets[path] = get_targets(end)
        return self._targets[path]

    def _end(self, relationship: Any) -> Any:
        """The first relationship of a chain that does not forward to one; any of a ring."""
        stage = relationship.GetStage()
        passed: dict[Any, None] = {}
        end = relationship
        while following := _only(own_targets(end)):
            path = end.GetPath()
            if path in self._ends or path in passed:
                end = self._ends.get(path, end)
                break
            following = stage.GetRelationshipAtPath(following)
            if not following:
                break
            passed[path] = None
            end = following
        self._ends.update(dict.fromkeys(passed, end))
        return end


def _only(targets: list[Any]) -> Any | None:
    """The target, if it is one and a property."""
    return targets[0] if len(targets) == 1 and targets[0].IsPropertyPath() else None
