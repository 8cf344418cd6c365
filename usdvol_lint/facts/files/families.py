"""Files that differ in their frame numbers alone, on disk or in a package."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import NamedTuple

from usdvol_lint.facts.files.assets import AssetSample
from usdvol_lint.facts.files.disk import Disk
from usdvol_lint.facts.files.frame_names import FrameName, read_frame_name, read_lost_number
from usdvol_lint.facts.files.places import Place, place_of

Family = tuple[str, str, str]
"""What files have in common that differ in their frame numbers alone.

The folder, and in a package the path in there; the name before and after the number.
"""


class Frames(NamedTuple):
    """The name of a file, and what is on disk of its sequence, by number."""

    name: FrameName
    family: Family
    on_disk: Mapping[int, str]


class Families:
    """The files on disk of which a file may be one frame, looked for once for all of them."""

    def __init__(self, disk: Disk) -> None:
        self._disk = disk
        self._on_disk: dict[tuple[Family, int], Mapping[int, str]] = {}

    def around(self, sample: AssetSample, *, is_lost: bool) -> Frames | None:
        """The name of a file as that of a frame, and the frames beside it; None if it is none."""
        place = place_of(sample.resolved)
        inside, name = place.split
        frame = read_lost_number(name) if is_lost else read_frame_name(name)
        if frame is None:
            return None
        family = _around(place, frame)
        key = family, len(frame.digits)
        if key not in self._on_disk:
            self._on_disk[key] = frame.among(self._disk.listing(place.folder).names_in(inside))
        return Frames(frame, family, self._on_disk[key])


def read_family(path: str) -> tuple[FrameName, Family] | None:
    """A file's name as that of a frame, by its absolute path, and its family; None if no frame."""
    place = place_of(path)
    frame = read_frame_name(place.split[1])
    return (frame, _around(place, frame)) if frame else None


def _around(place: Place, frame: FrameName) -> Family:
    return os.path.join(place.folder, place.split[0]), frame.before, frame.after
