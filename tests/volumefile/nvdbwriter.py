"""Writes NanoVDB files byte by byte, right ones and wrong ones."""

from __future__ import annotations

import re
import struct
import zlib

from process import SAMPLES

SAMPLE = SAMPLES / "type_all_z.nvdb"
VERSION = 32 << 21 | 4 << 10 | 2


def entry(
    name: bytes = b"density\0",
    kind: int = 1,
    grid_class: int = 2,
    size: int = 0,
    world: tuple[float, ...] = (-8, 4, 0, 16, 10, 50),
    box: tuple[int, ...] = (-4, 2, 0, 7, 4, 24),
    voxel: tuple[float, ...] = (2, 2, 2),
    codec: int = 2,
    name_size: int | None = None,
) -> bytes:
    length = len(name) if name_size is None else name_size
    head = struct.pack("<4Q2I", 9999, size, 0, 36, kind, grid_class)
    boxes = struct.pack("<6d6i3d", *world, *box, *voxel)
    return head + boxes + struct.pack("<I7IHHI", length, *range(7), codec, 0, VERSION) + name


def segment(
    *entries: bytes,
    data: bytes = b"",
    version: int = VERSION,
    signature: bytes = b"NanoVDB2",
    count: int | None = None,
) -> bytes:
    count = len(entries) if count is None else count
    return struct.pack("<8sIHH", signature, version, count, 2) + b"".join(entries) + data


def buffers() -> list[bytes]:
    """The grids of the sample as they lie in memory."""
    content = SAMPLE.read_bytes()
    found = []
    for match in re.finditer(rb"NanoVDB0", content):
        name_size = struct.unpack_from("<I", content, match.start() + 16 + 136)[0]
        at = match.start() + 16 + 176 + name_size
        (size,) = struct.unpack_from("<Q", content, at)
        found.append(zlib.decompress(content[at + 8 : at + 8 + size]))
    return found


def bare(grids: list[bytes]) -> bytes:
    """Grids as a file of buffers, each of which says how many they are."""
    return b"".join(
        b"NanoVDB1" + grid[8:24] + struct.pack("<II", index, len(grids)) + grid[32:]
        for index, grid in enumerate(grids)
    )


def turned(grid: bytes, matrix: tuple[float, ...], translation: tuple[float, ...]) -> bytes:
    """A grid with another map."""
    return (
        grid[:384]
        + struct.pack("<9d", *matrix)
        + grid[456:528]
        + struct.pack("<3d", *translation)
        + grid[552:]
    )
