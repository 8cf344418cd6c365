"""The fields of one prim that name the same files."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Hashable, Iterable
from typing import Any, NamedTuple

from usdvol_lint.facts.files.assets import AssetSamples
from usdvol_lint.facts.usd.instances import as_shown


class Alike(NamedTuple):
    """How many other fields of its prim name the same files, at the same times.

    `is_first`: whether none of them is shown before this one; `others`: words on them, or "".
    """

    is_first: bool
    others: str


class Namesakes:
    """The fields of one prim that name the same files, of all prims."""

    def __init__(self, every: Iterable[tuple[Any, AssetSamples]]) -> None:
        self._known: dict[Any, list[Any]] = {}
        groups: dict[Hashable, list[tuple[Any, AssetSamples]]] = defaultdict(list)
        for field, paths in every:
            if paths.samples:
                groups[field.GetParent(), paths.samples].append((field, paths))
        for group in groups.values():
            if len(group) > 1:
                self._add(group)

    def of(self, field: Any, like: Callable[[Any], Any] | None = None) -> Alike:
        """What is known of a field; others are those for which `like` gives the same."""
        family = self._known.get(field, [field])
        if like and len(family) > 1:
            family = [other for other in family if like(other) == like(field)]
        count = len(family) - 1
        words = f", as in {count} other field{'s' * (count > 1)}" if count else ""
        return Alike(family[0] == field, words)

    def _add(self, group: Iterable[tuple[Any, AssetSamples]]) -> None:
        """Adds fields with the same paths: in layers of different folders these lead elsewhere."""
        by_place: dict[str, list[Any]] = defaultdict(list)
        for field, paths in group:
            by_place[paths.anchored(paths.samples[0])].append(field)
        for fields in by_place.values():
            family = as_shown(fields)
            self._known |= dict.fromkeys(family, family)
