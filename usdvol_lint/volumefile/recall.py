"""The frames of a sequence differ in a few numbers: a file laid out like one before is known."""

from __future__ import annotations

from collections.abc import Iterable
from operator import is_not, itemgetter
from struct import Struct
from typing import Any, TypeAlias

from usdvol_lint.volumefile.model import BOUNDS_NAMES, Grid, IndexBounds, VolumeFile
from usdvol_lint.volumefile.window import Note, Window

_LONGEST = 1 << 14
_LAYOUTS = 8
_FORMS = {"offsets": "3q", **dict.fromkeys(BOUNDS_NAMES, "3i")}
_SIZE = 4

Fields: TypeAlias = tuple[Any, ...]


class Recall:
    """Reads files as the OpenVDB reader does, those of the last few layouts at a glance.

    A layout is everything before the voxels but for what the reader noted: where the parts lie,
    and the values of metadata, of which only the bounds are looked at.
    So files are recalled without any metadata and UUID.
    """

    def __init__(self) -> None:
        self._layouts: list[_Layout] = []

    def find(self, window: Window) -> VolumeFile | None:
        """The file in the window if its layout is known and nothing is odd about it."""
        for number, layout in enumerate(self._layouts):
            file = layout.match(window)
            window.position = 0
            if file is not None:
                if number:
                    self._layouts.insert(0, self._layouts.pop(number))
                return file
        return None

    def learn(self, window: Window, file: VolumeFile) -> None:
        """Remembers the layout of the file, which was just read from the window."""
        heads = tuple(_heads(window))
        if heads and len(heads) == len(file.grids):
            layout = _Layout(heads, file)
            window.position = 0
            if layout.match(window) == file:
                self._layouts = [layout, *self._layouts[: _LAYOUTS - 1]]


class _Layout:
    """The heads of a file's grids; `file` is the one it was learnt from."""

    def __init__(self, heads: tuple[_Head, ...], file: VolumeFile) -> None:
        self._heads = heads
        self._file = file

    def match(self, window: Window) -> VolumeFile | None:
        grids = []
        for head, grid in zip(self._heads, self._file.grids, strict=True):
            fields = head.match(window)
            if fields is None:
                return None
            grids.append(_with_bounds(grid, head.bounds(fields)))
        differ = any(map(is_not, grids, self._file.grids))
        return self._file._replace(grids=tuple(grids)) if differ else self._file


class _Head:
    """What stands before the voxels of one grid, and before the first one the file's header.

    It is taken apart into constants and numbers; a value that was skipped ends a part of it, since
    values of any size may stand in its place.
    """

    def __init__(self, window: Window, start: int, notes: Iterable[Note]) -> None:
        """The head at byte `start` of the file in the window."""
        self._parts: list[tuple[Struct, bool]] = []
        self._data = 0
        names: list[str] = []
        form, at = "<", start
        for name, position, size in notes:
            if name == "skipped":
                self._parts.append((Struct(f"{form}{position - _SIZE - at}sI"), True))
                names += ["", "size"]
                form, at = "<", position + size
                continue
            form += f"{position - at}s" + _FORMS.get(name, f"{size}x")
            names += ["", *([name] * 3 if name in _FORMS else ())]
            at = position + size
            if name == "offsets":
                self._data = at - start
        self._parts.append((Struct(form), False))
        self._constants = _picker(names, "")
        self._offsets = _picker(names, "offsets")
        self._low, self._high = (_picker(names, name) for name in BOUNDS_NAMES)
        self._has_bounds = all(name in names for name in BOUNDS_NAMES)
        window.position = start
        fields = self._fields(window)
        self._expected = fields and self._constants(fields)
        self.end = self._offsets(fields)[-1] if fields else start

    def match(self, window: Window) -> Fields | None:
        """What the file in the window has in the places of a head like this; goes to its end."""
        start = window.position
        fields = self._fields(window)
        if fields is None or self._constants(fields) != self._expected:
            return None
        data, blocks, end = self._offsets(fields)
        if data != start + self._data or not window.position <= blocks <= end <= window.size:
            return None
        window.position = end
        return fields

    def bounds(self, fields: Fields) -> IndexBounds | None:
        return (self._low(fields), self._high(fields)) if self._has_bounds else None

    def _fields(self, window: Window) -> Fields | None:
        fields: Fields = ()
        for form, has_more in self._parts:
            if window.position + form.size > window.size:
                return None
            fields += window.unpack(form)
            if has_more:
                window.position += fields[-1]
        return fields


def _heads(window: Window) -> Iterable[_Head]:
    """The heads that the reader's notes tell of."""
    start, notes = 0, list[Note]()
    for note in window.notes:
        notes.append(note)
        if note.name == "head":
            taken = sum(note.size for note in notes if note.name == "skipped")
            if note.position - start - taken > _LONGEST:
                return
            head = _Head(window, start, notes)
            yield head
            start, notes = head.end, []


def _with_bounds(grid: Grid, bounds: IndexBounds | None) -> Grid:
    if bounds is None or bounds == grid.index_bounds:
        return grid
    (x, y, z), (u, v, w) = bounds
    is_empty = x > u or y > v or z > w
    return grid._replace(index_bounds=None if is_empty else bounds, is_empty=is_empty)


def _picker(names: list[str], wanted: str) -> Any:
    places = [place for place, name in enumerate(names) if name == wanted]
    return itemgetter(*places) if places else None
