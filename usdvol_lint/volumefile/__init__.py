"""Readers of volume files: header and metadata only, never voxels."""

from __future__ import annotations

from usdvol_lint.volumefile.model import (
    ErrorCode,
    Format,
    Grid,
    IndexBounds,
    Metadatum,
    VolumeFile,
    VolumeFileError,
)
from usdvol_lint.volumefile.signatures import HDF5, LFS_POINTER, NANOVDB, OGAWA, OPENVDB
from usdvol_lint.volumefile.transform import Bounds, Frustum, Matrix, Point, Transform
from usdvol_lint.volumefile.window import Window, open_window

__all__ = [
    "Bounds",
    "ErrorCode",
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
    "read_volume_file",
    "read_window",
]

_SIGNATURES = (OPENVDB, *NANOVDB, OGAWA, HDF5)
_LONGEST_SIGNATURE = len(LFS_POINTER)


def read_volume_file(path: str, offset: int = 0, size: int | None = None) -> VolumeFile:
    """Reads the volume file at `path`, whatever its extension.

    `offset` and `size`, in bytes, choose a part of it, such as a file stored in a package.
    Raises `VolumeFileError`, and nothing else, for whatever may be wrong with the file.
    """
    if offset < 0 or (size is not None and size < 0):
        raise ValueError("offset and size can't be negative")
    with open_window(path, offset, size) as window:
        return read_window(window)


def read_window(window: Window) -> VolumeFile:
    """Reads the volume file in a window; its first bytes tell the format."""
    # A reader is imported when its signature is met: most stages have files of one format.
    head = window.peek(_LONGEST_SIGNATURE)
    if not head:
        raise VolumeFileError("not-a-file", "empty (0 bytes)")
    if head.startswith(LFS_POINTER):
        raise VolumeFileError("not-a-file", "a Git-LFS pointer, not the file itself")
    if head.startswith(OPENVDB):
        from usdvol_lint.volumefile.vdb import read_vdb

        return read_vdb(window)
    if head.startswith(NANOVDB):
        from usdvol_lint.volumefile.nvdb import read_nvdb

        return read_nvdb(window)
    if head.startswith(OGAWA):
        from usdvol_lint.volumefile.f3d import volume_file
        from usdvol_lint.volumefile.ogawa import read_ogawa

        return volume_file(read_ogawa(window))
    if head.startswith(HDF5):
        from usdvol_lint.volumefile.f3d import volume_file
        from usdvol_lint.volumefile.hdf5 import read_hdf5

        return volume_file(read_hdf5(window))
    if any(signature.startswith(head) for signature in _SIGNATURES):
        raise VolumeFileError("truncated", f"the file ends after {len(head)} bytes", len(head))
    raise VolumeFileError(
        "not-a-volume-file", "its first bytes are not those of OpenVDB, NanoVDB or Field3D"
    )
