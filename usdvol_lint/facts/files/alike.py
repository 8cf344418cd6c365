"""The fields of one prim that name the same files."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Hashable, Iterable, Iterator
from typing import Any, TypeAlias

from usdvol_lint.facts.files.assets import AssetSamples
from usdvol_lint.facts.usd.instances import as_shown, shown

_Field: TypeAlias = tuple[Any, AssetSamples]


class Namesakes:
    """The fields of one prim that name the same files, of all prims."""

    def __init__(self, every: Iterable[tuple[Any, AssetSamples]]) -> None:
        self._known: dict[Any, list[Any]] = {}
        named = [(field, paths) for field, paths in every if paths.samples]
        # To hash the paths of a long sequence takes long: only where the first ones are the same.
        for likely in _groups(named, lambda paths: paths.samples[0]):
            for group in _groups(likely, lambda paths: paths.samples):
                self._add(group)

    def key(self, field: Any) -> str | None:
        """What all fields of a prim have in common that name the same files; None for one alone."""
        family = self._known.get(field)
        return shown(family[0]).path if family else None

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
