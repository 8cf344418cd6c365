"""Which field a relationship that binds none was probably intended to target."""

from __future__ import annotations

from bisect import bisect
from collections import defaultdict
from collections.abc import Iterable
from typing import Any

from usdvol_lint.facts.volumes.bindings import Binding
from usdvol_lint.facts.volumes.states import TargetState
from usdvol_lint.nearest import Vocabulary


class FieldIndex:
    """The paths of all fields, by name and by parent, to search for one near a wrong path."""

    def __init__(self, fields: Iterable[Any], volumes: Iterable[Any]) -> None:
        self._volumes = frozenset(volume.GetPath() for volume in volumes)
        self._by_name: dict[str, list[Any]] = defaultdict(list)
        self._by_parent: dict[Any, dict[str, Any]] = defaultdict(dict)
        for path in sorted(field.GetPath() for field in fields):
            self._by_name[path.name].append(path)
            self._by_parent[path.GetParentPath()][path.name] = path
        self._names: dict[Any, Vocabulary] = {}

    def intended_by(self, binding: Binding) -> Any | None:
        """The path of the field that a binding without one was probably intended to target."""
        path = _intended_path(binding)
        return self.closest(path, binding.property.GetPrim().GetPath()) if path else None

    def closest(self, path: Any, volume: Any) -> Any | None:
        """A sibling of the path with nearly its name, or the closest field with exactly its name.

        None where two are equally close, as a wrong guess misleads, and where the closest is below
        a Volume other than the one at the path `volume`.
        """
        parent = path.GetParentPath()
        if sibling := self._names_below(parent).closest(path.name, cutoff=0.7):
            return self._by_parent[parent][sibling]
        namesakes = self._by_name.get(path.name, [])
        index = bisect(namesakes, path)  # in sorted order, the closest are next to it
        shared = defaultdict(list)
        for other in namesakes[max(index - 2, 0) : index + 2]:
            shared[path.GetCommonPrefix(other).pathElementCount].append(other)
        closest = shared[max(shared)] if shared else []
        if len(closest) != 1:
            return None
        above = self._volumes.intersection(closest[0].GetPrefixes())
        return closest[0] if above <= {volume} else None

    def _names_below(self, parent: Any) -> Vocabulary:
        """The names of the fields right below a path, in which those of its Volume are sought."""
        if parent not in self._names:
            self._names[parent] = Vocabulary(self._by_parent.get(parent, ()), fold=str)
        return self._names[parent]


def _intended_path(binding: Binding) -> Any | None:
    """The path at which the field of a binding would be expected; None where there is no clue."""
    if not binding.targets:
        return binding.property.GetPrim().GetPath().AppendChild(binding.key)
    if binding.target and binding.target.state in (TargetState.MISSING, TargetState.PROPERTY):
        return binding.target.path.GetPrimPath()
    if binding.target and binding.target.state is TargetState.NOT_A_FIELD:
        return binding.target.path.AppendChild(binding.key)
    return None
