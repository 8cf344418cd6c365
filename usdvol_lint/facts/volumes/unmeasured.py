"""The grids of a Volume whose files do not tell where their voxels are."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, ClassVar

from usdvol_lint.facts.grids.timelines import Timeline
from usdvol_lint.words import quoted


@dataclass(frozen=True, slots=True)
class UnmeasuredGrids:
    """The first such grid and its field, the times at which fields have one, and of how many."""

    attribute: Any
    field: str
    grid: str
    times: tuple[float, ...]
    at_default: bool
    checked: int
    fields: int
    asset: ClassVar[None] = None

    @property
    def shown(self) -> str:
        """The grid as messages name it."""
        return f"the grid {quoted(self.grid)} of <{self.field}>"

    @property
    def count(self) -> str:
        """In words how many times and fields this concerns; empty for one of each."""
        times = len(self.times) + self.at_default
        words = [f"at {times} of {self.checked} times"] if self.checked > 1 else []
        if self.fields > 1:
            words.append(f"in {self.fields} fields")
        return f" ({', '.join(words)})" if words else ""


def find_unmeasured(
    attribute: Any, fields: Iterable[tuple[str, Timeline]]
) -> UnmeasuredGrids | None:
    """Looks through the files of fields, each given with its path, at all times."""
    found, checked = [], set()
    for field, timeline in fields:
        for time, grid in timeline.grids():
            checked.add(time)
            if grid and grid.is_unmeasured:
                found.append((field, grid.label, time))
    if not found:
        return None
    field, grid_name, _ = found[0]
    times = {time for _, _, time in found}
    return UnmeasuredGrids(
        attribute=attribute,
        field=field,
        grid=grid_name,
        times=tuple(sorted(time for time in times if time is not None)),
        at_default=None in times and len(checked) > 1,
        checked=len(checked),
        fields=len({field for field, _, _ in found}),
    )
