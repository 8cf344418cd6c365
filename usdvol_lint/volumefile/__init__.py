"""Readers of field files: header and metadata only, never voxels."""

from __future__ import annotations

import os
from typing import TypeAlias

from usdvol_lint.volumefile.model import (
    ErrorCode,
    FileWarning,
    Format,
    Grid,
    IndexBounds,
    Metadatum,
    VolumeFile,
    VolumeFileError,
    WarningCode,
)
from usdvol_lint.volumefile.transform import Bounds, Frustum, Matrix, Point, Transform
from usdvol_lint.volumefile.window import Window, open_window

__all__ = [
    "Bounds",
    "ErrorCode",
    "FileKey",
    "FileWarning",
    "Format",
    "Frustum",
    "Grid",
    "IndexBounds",
    "Matrix",
    "Metadatum",
    "Point",
    "Transform",
    "VolumeFile",
    "VolumeFileError",
    "WarningCode",
    "file_key",
    "read_volume_file",
    "read_window",
]

FileKey: TypeAlias = tuple[int, int, int, int]
"""Device, inode, size and time of change: a file with the same key has the same content."""

_LFS_SIGNATURE = b"version https://git-lfs"
_LONGEST_SIGNATURE = len(_LFS_SIGNATURE)


def read_volume_file(path: str, offset: int = 0, size: int | None = None) -> VolumeFile:
    """What the volume file at `path` says, whatever its extension.

    `offset` and `size` choose a part of the file, such as a file stored in a package.
    Raises `VolumeFileError`, and nothing else, for whatever may be wrong with the file.
    """
    if offset < 0 or (size is not None and size < 0):
        raise ValueError("offset and size can't be negative")
    with open_window(path, offset, size) as window:
        return read_window(window)


def read_window(window: Window) -> VolumeFile:
    """What the volume file in a window says, from its start."""
    # Each reader is imported where its signature is met: most stages have files of one kind.
    head = window.peek(_LONGEST_SIGNATURE)
    if not head:
        raise VolumeFileError("not-a-file", "empty (0 bytes)")
    if head.startswith(_LFS_SIGNATURE):
        raise VolumeFileError("not-a-file", "a Git-LFS pointer, not the file itself")

    from usdvol_lint.volumefile import hdf5, nvdb, ogawa, vdb

    if head.startswith(vdb.SIGNATURE):
        return vdb.read_vdb(window)
    if head.startswith(nvdb.SIGNATURES):
        return nvdb.read_nvdb(window)

    from usdvol_lint.volumefile import f3d

    if head.startswith(ogawa.SIGNATURE):
        return f3d.volume_file(ogawa.read_ogawa(window))
    if head.startswith(hdf5.SIGNATURE):
        return f3d.volume_file(hdf5.read_hdf5(window))

    signatures = (vdb.SIGNATURE, *nvdb.SIGNATURES, ogawa.SIGNATURE, hdf5.SIGNATURE)
    if any(signature.startswith(head) for signature in signatures):
        raise VolumeFileError("truncated", f"the file ends after {len(head)} bytes", len(head))
    raise VolumeFileError(
        "not-a-volume-file", "it begins like no OpenVDB, NanoVDB or Field3D file", 0
    )


def file_key(path: str) -> FileKey:
    """What tells one state of a file from another, to remember what was read by."""
    try:
        status = os.stat(path)
    except (OSError, ValueError) as error:
        raise VolumeFileError("not-a-file", str(error)) from None
    return status.st_dev, status.st_ino, status.st_size, status.st_mtime_ns
