"""Reads Field3D's groups from an HDF5 file with h5py, an optional dependency."""

from __future__ import annotations

import importlib
import io
from struct import Struct
from typing import Any

from usdvol_lint.volumefile.f3d import DEEPEST, LARGEST_VALUE, MOST, Group
from usdvol_lint.volumefile.model import MetadataValue, Metadatum, VolumeFileError
from usdvol_lint.volumefile.signatures import HDF5
from usdvol_lint.volumefile.window import Window

# By version of the superblock: the positions of the size of offsets and of the end of the file.
_END = {0: (13, 40), 1: (13, 44), 2: (9, 28), 3: (9, 28)}
_LONGEST_SUPERBLOCK = 100
_U64 = Struct("<Q")


def read_hdf5(window: Window) -> Group:
    """The root group; raises VolumeFileError, of code `needs-h5py` if h5py is not installed."""
    end = _stored_end(window)
    if end > window.size:
        message = f"the file ends at byte {window.size} of {end}"
        raise VolumeFileError("truncated", message, window.size)
    try:
        h5py: Any = importlib.import_module("h5py")
    except ImportError:
        message = "Field3D in HDF5 can be read only where h5py is installed"
        raise VolumeFileError("needs-h5py", message) from None
    try:
        with h5py.File(_Stream(window), "r") as file:
            return _Reader(h5py).group("", file, 1)
    except VolumeFileError:
        raise
    except Exception as error:  # h5py raises many types, by errors of its C library
        raise VolumeFileError("not-a-volume-file", f"HDF5: {error!s:.200}") from None


def _stored_end(window: Window) -> int:
    """The end of the file as its superblock has it; 0 for an unknown kind of superblock."""
    head = window.read(_LONGEST_SUPERBLOCK)
    window.position = 0
    size_at, end_at = _END.get(head[len(HDF5)], (0, 0))
    return int(_U64.unpack_from(head, end_at)[0]) if end_at and head[size_at] == 8 else 0


class _Reader:
    """Reads groups; `left` is how many more names it may meet."""

    def __init__(self, h5py: Any) -> None:
        self.h5py = h5py
        self.left = MOST

    def group(self, name: str, stored: Any, depth: int) -> Group:
        attributes = {key: self.attribute(stored.attrs, key) for key in self.names(stored.attrs)}
        group = Group(name, attributes)
        if depth < DEEPEST:
            for key in self.names(stored):
                # Soft and external links are not followed: they may lead to other files.
                link = stored.get(key, getclass=True, getlink=True)
                if link is self.h5py.HardLink and stored.get(key, getclass=True) is self.h5py.Group:
                    group.groups.append(self.group(key, stored[key], depth + 1))
        return group

    def names(self, mapping: Any) -> list[str]:
        self.left -= len(mapping)
        if self.left < 0:
            raise VolumeFileError("not-a-volume-file", f"more than {MOST} groups and attributes")
        return list(mapping)

    def attribute(self, attributes: Any, name: str) -> Metadatum:
        identifier = attributes.get_id(name)
        size = int(identifier.get_storage_size())
        if size > LARGEST_VALUE:
            return Metadatum("unknown", None, size)
        value = _plain(attributes[name])
        kind = "string" if isinstance(value, str) else str(identifier.dtype)
        return Metadatum(kind, value, size)


def _plain(value: Any) -> MetadataValue:
    """NumPy's values as a single one or a flat tuple; None if they are of another type."""
    values = value.ravel().tolist() if hasattr(value, "ravel") else [value]
    first = values[0] if len(values) == 1 else None
    if isinstance(first, bytes):
        return first.decode("utf-8", "surrogateescape")
    if isinstance(first, bool | int | float | str):
        return first
    return tuple(values) if all(isinstance(number, int | float) for number in values) else None


class _Stream(io.RawIOBase):
    """A window as a binary file for h5py."""

    def __init__(self, window: Window) -> None:
        self.window = window

    def readable(self) -> bool:
        return True

    def seekable(self) -> bool:
        return True

    def tell(self) -> int:
        return self.window.position

    def seek(self, offset: int, whence: int = io.SEEK_SET) -> int:
        window = self.window
        start = {io.SEEK_SET: 0, io.SEEK_CUR: window.position, io.SEEK_END: window.size}[whence]
        window.position = max(0, start + offset)
        return window.position

    def readinto(self, buffer: Any) -> int:
        window = self.window
        found = window.read(max(0, min(len(buffer), window.size - window.position)))
        buffer[: len(found)] = found
        return len(found)
