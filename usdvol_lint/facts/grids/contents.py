"""The content of one file, and how it compares with what the field claims about it."""

from __future__ import annotations

import os
from collections.abc import Callable, Hashable
from typing import Any, ClassVar, NamedTuple, TypeVar

from usdvol_lint.facts.files.assets import AssetSample
from usdvol_lint.facts.grids.claims import Claim
from usdvol_lint.volumefile import tokens
from usdvol_lint.volumefile.cache import Reading
from usdvol_lint.volumefile.model import Fault, Format, Grid, VolumeFile, quoted_short

_NAMES_SHOWN = 8
_PART_MARKS = (".", "_", ":", "")
_UNREAD = ("needs-h5py", "not-in-place")
_ANNOUNCED: dict[str, Format] = {".nvdb": "nanovdb", ".vdb": "openvdb", ".f3d": "field3d"}
"""The format that an extension announces."""
_NAMES = {"openvdb": "an OpenVDB", "nanovdb": "a NanoVDB", "field3d": "a Field3D"}

_K = TypeVar("_K", bound=Hashable)


class Content(NamedTuple):
    """The content of one sample's file, and what the field claims about it at that time.

    `wanted` is the file format that the field's schema asks for.
    """

    sample: AssetSample
    claim: Claim
    reading: Reading
    wanted: Format

    @property
    def fault(self) -> Fault | None:
        """What is wrong with the file; None also if it was not read."""
        return None if self.unread else self.reading.fault

    @property
    def fault_message(self) -> str:
        """The fault in words, or empty."""
        return self.fault.message if self.fault else ""

    @property
    def unread(self) -> str | None:
        """Why the file was not read, in words; None if it was."""
        fault = self.reading.fault
        return fault.message if fault and fault.code in _UNREAD else None

    @property
    def unexpected_format(self) -> Format | None:
        """The file's format, if neither its extension nor the schema announces it; else None.

        A NanoVDB file called `.nvdb` is announced: the schema does not ask for it, but some
        renderers read it.
        """
        file = self.reading.file
        if file is None or file.format == self.wanted:
            return None
        return None if _ANNOUNCED.get(self._extension) == file.format else file.format

    @property
    def swapped_format(self) -> Format | None:
        """The file's format, if the field wants another one and the extension shows that it might.

        None where the extension is that of the wanted format, so that only the content tells, and
        for a NanoVDB file called `.nvdb` where OpenVDB is wanted.
        """
        file = self.reading.file
        if file is None or file.format == self.wanted:
            return None  # nearly always, and the extension need not be looked at
        announced = _ANNOUNCED.get(self._extension)
        is_known = file.format == announced == "nanovdb" and self.wanted == "openvdb"
        return None if is_known or announced == self.wanted else file.format

    @property
    def is_read_by_some(self) -> bool:
        """Whether some renderers read the file, though the field wants another format of it."""
        file = self.reading.file
        return file is not None and (file.format, self.wanted) == ("nanovdb", "openvdb")

    @property
    def foreign(self) -> str:
        """What the file is, in another format than the field wants, in words that follow `is`."""
        name = _NAMES[self.reading.file.format] if self.reading.file else "no volume"
        if self.is_read_by_some:
            return f"{name} file, which some renderers read and Storm does not"
        return f"{name} file, but the prim is {_NAMES[self.wanted]}Asset"

    @property
    def is_no_volume(self) -> bool:
        """Whether the file is none of a known format."""
        fault = self.fault
        if fault is None or self.reading.file is not None:
            return False
        return fault.code == "not-a-volume-file"

    @property
    def _extension(self) -> str:
        return os.path.splitext(self.sample.resolved.rstrip("]"))[1].lower()

    @property
    def file(self) -> VolumeFile | None:
        """What was read, if it can be relied on; of a truncated file what comes before its end."""
        fault = self.reading.fault
        is_sound = fault is None or fault.code == "truncated"
        return self.reading.file if is_sound and not self.unexpected_format else None

    @property
    def grids(self) -> tuple[Grid, ...]:
        """The grids with the name and purpose that the field claims, in the order of the file.

        If it claims no name, the grid of a file that holds just one.
        """
        file, name, purpose = self.file, self.claim.name, self.claim.purpose
        if file is None:
            return ()
        grids = file.grids
        if purpose and file.format == "field3d":
            grids = tuple(grid for grid in grids if grid.purpose == purpose)
        if not name:
            return grids if file.complete and len(grids) == 1 else ()
        named = (
            tuple(grid for grid in grids if getattr(grid, attribute) == name)
            for attribute in ("unique_name", "label", "name")
        )
        return next(filter(None, named), ())

    @property
    def holds(self) -> str:
        """The names of the grids in the file, in words that follow `holds`."""
        shown = [_shown(grid) for grid in self.file.grids] if self.file else []
        if len(shown) > _NAMES_SHOWN:
            shown[_NAMES_SHOWN - 1 :] = [f"{len(shown) - _NAMES_SHOWN + 1} more"]
        return ", ".join(shown) if shown else "no grids"

    @property
    def grid(self) -> Grid | None:
        """The grid that the claimed name and index select, the first without an index; or None."""
        index = self.claim.index or 0
        grids = self.grids
        return grids[index] if 0 <= index < len(grids) else None

    @property
    def grid_names(self) -> frozenset[str]:
        """The names of the grids in the file."""
        return frozenset(grid.unique_name for grid in self.file.grids) if self.file else frozenset()

    @property
    def parts(self) -> tuple[str, ...]:
        """The names of the grids that a vector of the claimed name is split into, if it is."""
        split = (tuple(f"{self.claim.name}{mark}{part}" for part in "xyz") for mark in _PART_MARKS)
        return next(filter(self.grid_names.issuperset, split), ())

    @property
    def purposes(self) -> tuple[str, ...]:
        """The purposes under which the file has grids with the name that the field claims."""
        grids = self.file.grids if self.file else ()
        name = self.claim.name
        named = [each.purpose for each in grids if name in (each.unique_name, each.label)]
        return tuple(dict.fromkeys(filter(None, named)))

    @property
    def label(self) -> str:
        """The label of the selected grid in quotes, or empty."""
        return quoted_short(self.grid.label) if self.grid else ""

    @property
    def data_types(self) -> tuple[str, ...]:
        """The values of `fieldDataType` that fit the selected grid, the best one first."""
        return tokens.data_types(self.grid.value_type, self.grid.half) if self.grid else ()

    @property
    def field_class(self) -> str:
        """The value of `fieldClass` that fits the selected grid, `unknown` if it has no class."""
        return tokens.field_class(self.grid.grid_class) if self.grid else "unknown"

    @property
    def written_class(self) -> str:
        """The class of the selected grid as the file spells it, or empty."""
        return self.grid.grid_class if self.grid else ""

    @property
    def role_hints(self) -> tuple[str, ...]:
        """The values of `vectorDataRoleHint` that fit the selected grid, none if any might."""
        grid = self.grid
        if grid is None or not grid.value_type.startswith("vec"):
            return ()
        hints = tokens.role_hints(grid.vector_type)
        return hints.fitting if hints.strength == "strong" else ()


class ContentClass:
    """An equivalence class of contents: a rule's question has the same answer for all of them.

    They differ in nothing but the sample, bounds, transforms and numbers in messages.
    `content` is the first of them.  Fields share the classes, on one stage and on the next.
    """

    LASTS: ClassVar = True

    __slots__ = ("_answers", "content")

    def __init__(self, content: Content) -> None:
        self.content = content
        self._answers: dict[Hashable, Any] = {}

    def answer(self, key: Callable[[Content], _K | None]) -> _K | None:
        """What a key function gives for the first content; equal functions are called once."""
        answers = self._answers
        if key not in answers:
            answers[key] = key(self.content)
        answer: _K | None = answers[key]
        return answer


def _shown(grid: Grid) -> str:
    if not (grid.name or grid.unique_name):
        return "an unnamed grid"
    return quoted_short(f"{grid.purpose}:{grid.label}" if grid.purpose else grid.label)
