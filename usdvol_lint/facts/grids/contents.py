"""The content of one file, held against what the field that names it says of it."""

from __future__ import annotations

import os
from collections.abc import Callable, Hashable
from typing import Any, NamedTuple, TypeVar

from usdvol_lint.facts.files.assets import AssetSample
from usdvol_lint.facts.grids.claims import Claim
from usdvol_lint.volumefile import tokens
from usdvol_lint.volumefile.cache import Fault, Reading
from usdvol_lint.volumefile.model import Format, Grid, VolumeFile, quoted_short

_NAMES = 8
_UNREAD = ("needs-h5py", "not-in-place")

_K = TypeVar("_K", bound=Hashable)


class Content(NamedTuple):
    """The content of one sample's file, and what the field says of it at that time.

    `wanted` is the format of files that the field's schema asks for.
    """

    sample: AssetSample
    claim: Claim
    reading: Reading
    wanted: Format

    @property
    def fault(self) -> Fault | None:
        """What is wrong with a file that was read."""
        return None if self.unread else self.reading.fault

    @property
    def fault_message(self) -> str:
        """The same in words; empty where nothing is wrong."""
        return self.fault.message if self.fault else ""

    @property
    def unread(self) -> str | None:
        """Why a file was not looked into, in words."""
        fault = self.reading.fault
        return fault.message if fault and fault.code in _UNREAD else None

    @property
    def unexpected_format(self) -> Format | None:
        """The format of the file if it is another than its extension or the schema lets expect.

        A NanoVDB file with an extension of its own is not the schema's, but read by some.
        """
        file = self.reading.file
        if file is None or file.format == self.wanted:
            return None
        extension = os.path.splitext(self.sample.resolved.rstrip("]"))[1].lower()
        told = {".nvdb": "nanovdb", ".vdb": "openvdb", ".f3d": "field3d"}.get(extension)
        return None if told == file.format else file.format

    @property
    def file(self) -> VolumeFile | None:
        """What can be relied on: of a truncated file as much as is there."""
        fault = self.reading.fault
        sound = fault is None or fault.code == "truncated"
        return self.reading.file if sound and not self.unexpected_format else None

    @property
    def grids(self) -> tuple[Grid, ...]:
        """The grids of the field's name, in the order of the file.

        Where the field gives no name, the only grid is meant.
        """
        file, name, purpose = self.file, self.claim.name, self.claim.purpose
        if file is None:
            return ()
        grids = file.grids
        if purpose and file.format == "field3d":
            grids = tuple(grid for grid in grids if grid.purpose == purpose)
        if not name:
            return grids if file.complete and len(grids) == 1 else ()
        found = (
            tuple(grid for grid in grids if getattr(grid, attribute) == name)
            for attribute in ("unique_name", "label", "name")
        )
        return next(filter(None, found), ())

    @property
    def holds(self) -> str:
        """What the file holds, in words that follow `holds`."""
        shown = [_shown(grid) for grid in self.file.grids] if self.file else []
        if len(shown) > _NAMES:
            shown[_NAMES - 1 :] = [f"{len(shown) - _NAMES + 1} more"]
        return ", ".join(shown) if shown else "no grids"

    @property
    def grid(self) -> Grid | None:
        """The grid that name and index select, the first where there is no index."""
        index = self.claim.index or 0
        grids = self.grids
        return grids[index] if 0 <= index < len(grids) else None

    @property
    def grid_names(self) -> frozenset[str]:
        """The names of the grids in the file, as far as they can be relied on."""
        return frozenset(grid.unique_name for grid in self.file.grids) if self.file else frozenset()

    @property
    def label(self) -> str:
        """The label of the grid that is selected, in quotes; empty where there is none."""
        return quoted_short(self.grid.label) if self.grid else ""

    @property
    def data_types(self) -> tuple[str, ...]:
        """The data types that fit the grid, the best one first."""
        return tokens.data_types(self.grid.value_type, self.grid.half) if self.grid else ()

    @property
    def field_class(self) -> str:
        """The class of the grid; unknown where it says none, or its format has none."""
        return tokens.field_class(self.grid.grid_class) if self.grid else "unknown"

    @property
    def written_class(self) -> str:
        """The same as the file has it."""
        return self.grid.grid_class if self.grid else ""

    @property
    def role_hints(self) -> tuple[str, ...]:
        """The roles that fit the grid's vectors; none where it tells nothing of them for sure."""
        grid = self.grid
        if grid is None or not grid.value_type.startswith("vec"):
            return ()
        hints = tokens.role_hints(grid.vector_type)
        return hints.fitting if hints.strength == "strong" else ()


class ContentClass:
    """What contents have in common that a rule says the same of; `content` is the first of them.

    It is shared by all fields of a stage, so a rule makes up its mind once.
    """

    __slots__ = ("_answers", "content")

    def __init__(self, content: Content) -> None:
        self.content = content
        self._answers: dict[Hashable, Any] = {}

    def answer(self, key: Callable[[Content], _K | None]) -> _K | None:
        """What a rule asks of these contents; `key` is known again if it is equal to itself."""
        answers = self._answers
        if key not in answers:
            answers[key] = key(self.content)
        found: _K | None = answers[key]
        return found


def _shown(grid: Grid) -> str:
    if not (grid.name or grid.unique_name):
        return "an unnamed grid"
    return quoted_short(f"{grid.purpose}:{grid.label}" if grid.purpose else grid.label)
