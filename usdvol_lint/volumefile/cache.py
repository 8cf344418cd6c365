"""Reads each volume file once, however often it is named."""

from __future__ import annotations

import re
from collections.abc import Hashable
from typing import NamedTuple

from usdvol_lint.volumefile import read_window
from usdvol_lint.volumefile.model import Fault, VolumeFile, VolumeFileError
from usdvol_lint.volumefile.recall import Recall
from usdvol_lint.volumefile.window import Window, open_window

_NUMBER = r"\d+"
_SIZE = 512
"""Bytes that a reading takes at least, and as many for each of its grids."""


class Reading(NamedTuple):
    """The result of reading a file.

    `file` has no metadata and no UUID; with a `fault` it is what was read before that, if anything.
    Files of equal `layout` differ in nothing but bounds, transforms and numbers in messages.
    """

    file: VolumeFile | None
    fault: Fault | None
    layout: Hashable


class VolumeFiles:
    """A cache of readings; a file is read anew if its size or time of change is another.

    `size` is about how many bytes they take.
    """

    def __init__(self) -> None:
        self.forget()

    def forget(self) -> None:
        """Reads every file anew from now on; the numbers of layouts then mean others."""
        self.size = 0
        self._readings: dict[tuple[int | None, ...], Reading] = {}
        self._layouts: dict[Hashable, int] = {}
        self._recall = Recall()
        self._last: tuple[VolumeFile | None, int] = (None, 0)

    def read(self, path: str, offset: int = 0, size: int | None = None) -> Reading:
        """What `read_volume_file` returns or raises, as a `Reading`."""
        try:
            with open_window(path, offset, size) as window:
                state = window.status
                key = (state.st_dev, state.st_ino, state.st_size, state.st_mtime_ns, offset, size)
                reading = self._readings.get(key)
                if reading is None:
                    reading = self._readings[key] = self._read(window)
                    grids = reading.file.grids if reading.file else ()
                    self.size += _SIZE * (1 + len(grids)) + window.text
                return reading
        except VolumeFileError as error:
            return self._failed(error)

    def _read(self, window: Window) -> Reading:
        file = self._recall.find(window)
        if file is None:
            try:
                file = _without_metadata(read_window(window))
            except VolumeFileError as error:
                return self._failed(error)
            self._recall.learn(window, file)
        return self._reading(file, None)

    def _failed(self, error: VolumeFileError) -> Reading:
        # The error itself must not be kept: its traceback keeps the reader and its window.
        partial = error.partial and _without_metadata(error.partial)
        return self._reading(partial, error.fault)

    def _reading(self, file: VolumeFile | None, fault: Fault | None) -> Reading:
        # Of frames that differ in nothing, `Recall` returns the same object.
        last, layout = self._last
        if file is None or file is not last or fault:
            layout = self._layouts.setdefault(layout_of(file, fault), len(self._layouts))
            self._last = (None if fault else file, layout)
        return Reading(file, fault, layout)


def _without_metadata(file: VolumeFile) -> VolumeFile:
    grids = tuple(grid._replace(metadata={}) if grid.metadata else grid for grid in file.grids)
    return file._replace(uuid=None, metadata={}, grids=grids)


def layout_of(file: VolumeFile | None, fault: Fault | None) -> Hashable:
    """All of a reading but bounds, transforms and numbers in messages; see `Reading`."""
    message = fault and (fault.code, re.sub(_NUMBER, "", fault.message))
    if file is None:
        return message
    return (
        message,
        file.format,
        file.version_number,
        file.complete,
        file.grid_count,
        *(
            (
                grid.name,
                grid.unique_name,
                grid.suffix,
                grid.purpose,
                grid.tree_type,
                grid.value_type,
                grid.half,
                grid.grid_class,
                grid.vector_type,
                grid.is_empty,
                grid.transform is None or grid.transform.frustum is None,
            )
            for grid in file.grids
        ),
    )
