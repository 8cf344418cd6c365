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
    """The contents of all files that a field names, by class; those of a class ascend in time.

    The default comes first.  `total` is the number of times at which files were looked for.
    Fields that name the same one file and claim the same about it share one.
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
        """The time of each file, class by class, and the grid that the field selects, if any."""
        for content_class, contents in self.classes:
            index: Any = content_class.answer(_grid_index)
            for sample, _, reading, _ in contents:
                if index is None or reading.file is None:
                    yield sample.time, None
                else:
                    yield sample.time, reading.file.grids[index]

    @property
    def selects_grids(self) -> bool:
        """Whether any file has the grid that the field selects."""
        return any(
            content_class.answer(_grid_index) is not None for content_class, _ in self.classes
        )

    @property
    def lacks_data_type(self) -> bool:
        """Whether every file has the grid, and no value of `fieldDataType` fits it."""
        contents = [content_class.content for content_class, _ in self.classes]
        return bool(contents) and all(
            content.grid is not None and not content.data_types for content in contents
        )

    @property
    def selected(self) -> frozenset[str]:
        """The names of the grids that the field selects."""
        grids = (content_class.content.grid for content_class, _ in self.classes)
        return frozenset(grid.unique_name for grid in grids if grid)

    @property
    def formats(self) -> frozenset[str]:
        """The formats of the files that were looked into."""
        readings = (content_class.content.reading.file for content_class, _ in self.classes)
        return frozenset(file.format for file in readings if file)

    @property
    def single_grid(self) -> bool:
        """Whether files were read, and each holds exactly one grid."""
        files = [content_class.content.file for content_class, _ in self.classes]
        return bool(files) and all(
            file is not None and file.complete and len(file.grids) == 1 for file in files
        )

    @property
    def files(self) -> list[tuple[Time, str]]:
        """The times and paths of the files, in ascending time, the default first."""
        samples = [content.sample for _, contents in self.classes for content in contents]
        return [(sample.time, sample.resolved) for sample in sorted(samples, key=_in_time)]


class FieldContents(NamedTuple):
    """The contents of a field's files, and the attribute that names them."""

    attribute: Any
    timeline: Timeline

    def without_swapped(self) -> FieldContents:
        """The contents but those of another format than the field wants, as the extension shows."""
        classes = self.timeline.classes
        kept = tuple([each for each in classes if not each[0].content.swapped_format])
        return FieldContents(self.attribute, Timeline(kept, self.timeline.total))

    def grouped(
        self, key: Callable[[Content], _K | None]
    ) -> Iterable[tuple[_K, Content, Affected]]:
        """Each value of a key function but None, with its first content and all its samples.

        Where the default is one spec's and the others another's, these are two.
        The function is called once for each class of contents, so it can't depend on the sample,
        on bounds and transforms, nor on numbers in messages.
        """
        groups: dict[_K, list[list[Content]]] = {}
        for content_class, contents in self.timeline.classes:
            value = content_class.answer(key)
            if value is not None:
                groups.setdefault(value, []).append(contents)
        return [(value, *found) for value in groups for found in self._affected(groups[value])]

    def _affected(self, lists: list[list[Content]]) -> Iterator[tuple[Content, Affected]]:
        contents = [content for each in lists for content in each]
        if len(lists) > 1:
            contents.sort(key=lambda content: _in_time(content.sample))
        samples = tuple(content.sample for content in contents)
        found = Affected(self.attribute, samples, self.timeline.total).by_opinion
        yield from zip(contents, found, strict=False)  # the default alone is the first


def _grid_index(content: Content) -> int | None:
    """The index of the selected grid among the grids of the file, or None."""
    file, grid = content.file, content.grid
    return file.grids.index(grid) if file and grid else None


def _in_time(sample: AssetSample) -> tuple[bool, float]:
    return sample.time is not None, sample.time or 0.0
