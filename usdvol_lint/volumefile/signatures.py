"""The first bytes of each format, by which the one reader that is needed is imported."""

from __future__ import annotations

from typing import Final

OPENVDB: Final = b" BDV\0\0\0\0"
NANOVDB: Final = (b"NanoVDB0", b"NanoVDB1", b"NanoVDB2")
OGAWA: Final = b"Ogawa"
HDF5: Final = b"\x89HDF\r\n\x1a\n"
LFS_POINTER: Final = b"version https://git-lfs"
"""Not a format, but what Git checks out in place of a large file that it did not fetch."""
