"""Writes OpenVDB files byte by byte, right ones and wrong ones; their voxels are noise."""

from __future__ import annotations

import struct
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

SIGNATURE = b" BDV\0\0\0\0"
UUID = b"01234567-89ab-cdef-0123-456789abcdef"

UNIT = (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)
"""An affine map that moves nothing."""

Offsets = Callable[[int, int, int], tuple[int, int, int]]


def text(content: str | bytes, length: int | None = None) -> bytes:
    """A string as OpenVDB stores it; `length` is a lie about it."""
    raw = content.encode() if isinstance(content, str) else content
    return struct.pack("<I", len(raw) if length is None else length) + raw


def metadatum(name: str | bytes, kind: str, value: bytes, size: int | None = None) -> bytes:
    size = len(value) if size is None else size
    return text(name) + text(kind) + struct.pack("<I", size) + value


def value(kind: str, *numbers: float) -> tuple[str, bytes]:
    """A metadata value of a type that is a row of numbers."""
    letter = {"bool": "?", "int32": "i", "int64": "q", "float": "f", "double": "d"}.get(kind)
    letter = letter or {"i": "i", "s": "f", "d": "d"}[kind[-1]]
    return kind, struct.pack(f"<{len(numbers)}{letter}", *numbers)


def string(content: str | bytes) -> tuple[str, bytes]:
    return "string", content.encode() if isinstance(content, str) else content


def metadata(
    entries: Mapping[str, tuple[str, bytes]], more: bytes = b"", count: int | None = None
) -> bytes:
    """A metadata map; `more` are entries as bytes, which `count` may or may not include."""
    count = len(entries) if count is None else count
    stored = (metadatum(name, kind, raw) for name, (kind, raw) in entries.items())
    return struct.pack("<I", count) + b"".join(stored) + more


def affine(*numbers: float, kind: str = "AffineMap") -> bytes:
    return text(kind) + struct.pack("<16d", *numbers)


def scale(x: float, y: float, z: float, kind: str = "ScaleMap") -> bytes:
    return text(kind) + struct.pack("<15d", x, y, z, *_derived(x, y, z))


def scale_translate(
    scale: tuple[float, float, float],
    translation: tuple[float, float, float],
    kind: str = "ScaleTranslateMap",
) -> bytes:
    return text(kind) + struct.pack("<18d", *translation, *scale, *_derived(*scale))


def _derived(*scale: float) -> list[float]:
    inverse = [1 / s if s else float("inf") for s in scale]
    return [*map(abs, scale), *inverse, *(i * i for i in inverse), *(i / 2 for i in inverse)]


def translation(x: float, y: float, z: float) -> bytes:
    return text("TranslationMap") + struct.pack("<3d", x, y, z)


def frustum(
    minimum: tuple[float, float, float],
    maximum: tuple[float, float, float],
    taper: float,
    depth: float,
    second: bytes | None = None,
) -> bytes:
    numbers = struct.pack("<8d", *minimum, *maximum, taper, depth)
    identity = affine(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)
    return text("NonlinearFrustumMap") + numbers + (identity if second is None else second)


def bounds(
    minimum: tuple[int, int, int], maximum: tuple[int, int, int]
) -> dict[str, tuple[str, bytes]]:
    return {
        "file_bbox_min": value("vec3i", *minimum),
        "file_bbox_max": value("vec3i", *maximum),
    }


@dataclass
class Grid:
    """A grid; `offsets` may falsify where its parts lie, `raw_metadata` what it says of itself."""

    name: str | bytes = "density"
    type: str | bytes = "Tree_float_5_4_3"
    parent: str = ""
    metadata: Mapping[str, tuple[str, bytes]] | None = None
    raw_metadata: bytes | None = None
    transform: bytes = field(default_factory=lambda: scale(1, 1, 1, "UniformScaleMap"))
    topology: bytes = b"\xa5" * 40
    voxels: bytes = b"\x5a" * 60
    offsets: Offsets | None = None

    def stored(self, position: int, *, seekable: bool = True) -> bytes:
        """The bytes of a grid that starts at `position`."""
        head = text(self.name) + text(self.type) + text(self.parent)
        entries = {"name": string(_stem(self.name))} if self.metadata is None else self.metadata
        said = metadata(entries) if self.raw_metadata is None else self.raw_metadata
        body = struct.pack("<I", 6) + said + self.transform
        start = position + len(head) + 24
        if self.parent:
            offsets, rest = (start, 0, start + len(body)), b""
        else:
            blocks = start + len(body) + len(self.topology)
            offsets = (start, blocks, blocks + len(self.voxels))
            rest = self.topology + self.voxels
        if self.offsets is not None:
            offsets = self.offsets(*offsets)
        return head + struct.pack("<3q", *(offsets if seekable else (0, 0, 0))) + body + rest


def _stem(name: str | bytes) -> str | bytes:
    return name.split("\x1e")[0] if isinstance(name, str) else name.split(b"\x1e")[0]


def vdb(
    *grids: Grid,
    version: int = 224,
    library: tuple[int, int] = (10, 0),
    seekable: bool = True,
    uuid: bytes = UUID,
    metadata_bytes: bytes = metadata({}),
    count: int | None = None,
) -> bytes:
    """A whole file; `count` is a lie about the number of grids."""
    file = SIGNATURE + struct.pack("<III?", version, *library, seekable) + uuid + metadata_bytes
    file += struct.pack("<I", (len(grids) if count is None else count) & 0xFFFFFFFF)
    for grid in grids:
        file += grid.stored(len(file), seekable=seekable)
    return file
