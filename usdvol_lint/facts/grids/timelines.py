"""The contents of all files that a field names, over time."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple, TypeVar

from usdvol_lint.facts.files.assets import Affected, AssetSample
from usdvol_lint.facts.grids.contents import Content, ContentClass
from usdvol_lint.facts.usd.steps import Time
from usdvol_lint.volumefile.model import Grid

_K = TypeVar("_K", bound=Hashable)


@dataclass(frozen=True, slots=True, eq=False)
class Timeline:
    """The contents of all files that a field names, by class, in ascending time, the default first.

    `total` is at how many times it was looked for them.  Fields that name the same single file and
    say the same of it share one.
    """

    classes: tuple[tuple[ContentClass, list[Content]], ...]
    total: int

    def answers(self, key: Callable[[Content], _K | None]) -> list[tuple[AssetSample, _K | None]]:
        """What a key function gives for each file, in ascending time, the default first."""
        found = [
            (content.sample, content_class.answer(key))
            for content_class, contents in self.classes
            for content in contents
        ]
        return sorted(found, key=lambda pair: _in_time(pair[0]))

    def grids(self) -> Iterator[tuple[Time, Grid | None]]:
        """The grid that name and index select, at each time."""
        for content_class, contents in self.classes:
            place: Any = content_class.answer(_place_of_grid)
            for sample, _, reading, _ in contents:
                if place is None or reading.file is None:
                    yield sample.time, None
                else:
                    yield sample.time, reading.file.grids[place]

    @property
    def selects_grids(self) -> bool:
        """Whether some file was looked into and has the grid that the field names."""
        return any(
            content_class.answer(_place_of_grid) is not None for content_class, _ in self.classes
        )

    @property
    def lacks_data_type(self) -> bool:
        """Whether the grids were found, and no `fieldDataType` stands for what they hold."""
        contents = [content_class.content for content_class, _ in self.classes]
        return bool(contents) and all(
            content.grid is not None and not content.data_types for content in contents
        )

    @property
    def single_grid(self) -> bool:
        """Whether files were looked into, and each holds exactly one grid."""
        files = [content_class.content.file for content_class, _ in self.classes]
        return bool(files) and all(
            file is not None and file.complete and len(file.grids) == 1 for file in files
        )

    @property
    def files(self) -> list[tuple[Time, str]]:
        """The files and when they are named, which fields may share."""
        samples = [content.sample for _, contents in self.classes for content in contents]
        return [(sample.time, sample.resolved) for sample in sorted(samples, key=_in_time)]


class FieldContents(NamedTuple):
    """The contents of a field's files, and the attribute that names them."""

    attribute: Any
    timeline: Timeline

    def grouped(
        self, key: Callable[[Content], _K | None]
    ) -> Iterable[tuple[_K, Content, Affected]]:
        """Each key that the contents have, None aside, with its first content and all samples.

        The key is asked for once among contents of one class: it can't depend on bounds,
        transforms and the numbers in messages, nor on the sample.
        """
        found: dict[_K, list[list[Content]]] = {}
        for content_class, contents in self.timeline.classes:
            value = content_class.answer(key)
            if value is not None:
                found.setdefault(value, []).append(contents)
        return [(value, *self._affected(groups)) for value, groups in found.items()]

    def _affected(self, groups: list[list[Content]]) -> tuple[Content, Affected]:
        together = [content for contents in groups for content in contents]
        if len(groups) > 1:
            together.sort(key=lambda content: _in_time(content.sample))
        samples = tuple(content.sample for content in together)
        return together[0], Affected(self.attribute, samples, self.timeline.total)


def _place_of_grid(content: Content) -> int | None:
    """Which of the grids in its file a content selects, counted from 0."""
    file, grid = content.file, content.grid
    return file.grids.index(grid) if file and grid else None


def _in_time(sample: AssetSample) -> tuple[bool, float]:
    return sample.time is not None, sample.time or 0.0
