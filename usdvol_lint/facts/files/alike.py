"""The fields of one prim that name the same files."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Hashable, Iterable, Iterator
from typing import Any, NamedTuple, TypeAlias

from usdvol_lint.facts.files.assets import AssetSamples
from usdvol_lint.facts.usd.instances import as_shown

_Field: TypeAlias = tuple[Any, AssetSamples]


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
        named = [(field, paths) for field, paths in every if paths.samples]
        # To hash the paths of a long sequence takes long: only where the first ones are the same.
        for likely in _groups(named, lambda paths: paths.samples[0]):
            for group in _groups(likely, lambda paths: paths.samples):
                self._add(group)

    def of(self, field: Any, like: Callable[[Any], Any] | None = None) -> Alike:
        """What is known of a field; others are those for which `like` gives the same."""
        family = self._known.get(field, [field])
        if like and len(family) > 1:
            family = [other for other in family if like(other) == like(field)]
        count = len(family) - 1
        words = f", as in {count} other field{'s' * (count > 1)}" if count else ""
        return Alike(family[0] == field, words)

    def _add(self, group: Iterable[_Field]) -> None:
        """Adds fields with the same paths: in layers of different folders these lead elsewhere."""
        by_place: dict[str, list[Any]] = defaultdict(list)
        for field, paths in group:
            by_place[paths.anchored(paths.samples[0])].append(field)
        for fields in by_place.values():
            family = as_shown(fields)
            self._known |= dict.fromkeys(family, family)


def _groups(
    fields: Iterable[_Field], key: Callable[[AssetSamples], Hashable]
) -> Iterator[list[_Field]]:
    """The fields of one prim that have the same key, where there are several."""
    groups: dict[Hashable, list[_Field]] = defaultdict(list)
    for field, paths in fields:
        groups[field.GetParent(), key(paths)].append((field, paths))
    return (group for group in groups.values() if len(group) > 1)
