"""A fast path for sequences: a frame with a known layout is decoded by it instead of parsed."""

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
_SIZE = 4  # bytes of the size before a value

Fields: TypeAlias = tuple[Any, ...]


class Recall:
    """The layouts of the OpenVDB files read last, by which others are decoded.

    A layout is all that precedes the voxels, except what the reader noted: offsets, and values of
    metadata, of which only the bounds are decoded.
    So files that are found have neither metadata nor a UUID.
    """

    def __init__(self) -> None:
        self._layouts: list[_Layout] = []

    def find(self, window: Window) -> VolumeFile | None:
        """The file in the window, if it has a known layout and is valid by it."""
        for number, layout in enumerate(self._layouts):
            file = layout.match(window)
            window.position = 0
            if file is not None:
                if number:
                    self._layouts.insert(0, self._layouts.pop(number))
                return file
        return None

    def learn(self, window: Window, file: VolumeFile) -> None:
        """Adds the layout of a file that was just read from the window, if it has one."""
        heads = tuple(_heads(window))
        # An instance has the bounds of another grid, which are not in its own head.
        if heads and [head.has_bounds for head in heads] == [_has_bounds(g) for g in file.grids]:
            layout = _Layout(heads, file)
            window.position = 0
            if layout.match(window) == file:
                self._layouts = [layout, *self._layouts[: _LAYOUTS - 1]]


class _Layout:
    """The heads of a file's grids, and the file that they are from."""

    def __init__(self, heads: tuple[_Head, ...], file: VolumeFile) -> None:
        self._heads = heads
        self._file = file

    def match(self, window: Window) -> VolumeFile | None:
        """The file in the window, or None if it has another layout.

        If it has the same bounds as the file of the layout, that very object is returned.
        """
        grids = []
        for head, grid in zip(self._heads, self._file.grids, strict=True):
            fields = head.match(window)
            if fields is None:
                return None
            grids.append(_with_bounds(grid, head.bounds(fields)))
        differ = any(map(is_not, grids, self._file.grids))
        return self._file._replace(grids=tuple(grids)) if differ else self._file


class _Head:
    """The bytes before the voxels of one grid, for the first grid including the file's header.

    They are divided into constants, which must match, and numbers, which may differ.
    A value that the reader skipped may have any size, so it ends a part with a `Struct` of its own.
    """

    def __init__(self, window: Window, start: int, notes: Iterable[Note]) -> None:
        """Takes over the head at byte `start` of the file in the window, and its notes."""
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
        # Other than three numbers each are not the bounds of this grid, or not its only ones.
        self.has_bounds = all(names.count(name) == 3 for name in BOUNDS_NAMES)
        window.position = start
        fields = self._fields(window)
        self._expected = fields and self._constants(fields)
        self.end = self._offsets(fields)[-1] if fields else start

    def match(self, window: Window) -> Fields | None:
        """The fields of such a head at the window's position, which moves to the grid's end."""
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
        return (self._low(fields), self._high(fields)) if self.has_bounds else None

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
    """The heads by the reader's notes; fewer than grids if one is too long to keep."""
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


def _has_bounds(grid: Grid) -> bool:
    return grid.index_bounds is not None or grid.is_empty


def _with_bounds(grid: Grid, bounds: IndexBounds | None) -> Grid:
    if bounds is None or bounds == grid.index_bounds:
        return grid
    (x, y, z), (u, v, w) = bounds
    is_empty = x > u or y > v or z > w
    return grid._replace(index_bounds=None if is_empty else bounds, is_empty=is_empty)


def _picker(names: list[str], wanted: str) -> Any:
    """A function from fields to those of a name."""
    indices = [index for index, name in enumerate(names) if name == wanted]
    return itemgetter(*indices) if indices else None
