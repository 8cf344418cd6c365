"""NanoVDB: files of segments (`NanoVDB0`, `NanoVDB2`) and bare grid buffers (`NanoVDB1`)."""

from __future__ import annotations

import zlib
from collections.abc import Mapping
from struct import Struct
from typing import Any, Final

from usdvol_lint.volumefile.model import (
    Grid,
    IndexBounds,
    Metadatum,
    VolumeFile,
    VolumeFileError,
    invalid,
    quoted_short,
)
from usdvol_lint.volumefile.signatures import NANOVDB
from usdvol_lint.volumefile.transform import Bounds, Point, Transform, finite, scale_translate
from usdvol_lint.volumefile.window import Window

MAJOR_VERSION: Final = 32
_LAST_MAJOR = 99
"""Major versions are counted up, so that one with more digits will not come."""

_BARE = b"NanoVDB1"
_MOST = 100_000
_LONGEST_NAME = 1 << 16
_NONE, _ZIP = 0, 1
_ZIPPED_HEAD = 4096  # bytes of a compressed grid, enough to decompress its header from

# signature, version, grids, codec
_SEGMENT = Struct("<8sIHH")
# sizes in memory and on disk, voxels, type, class, world box, index box, voxel size, name's
# length, codec
_ENTRY = Struct("<QQ8xQII6d6i3dI28xH6x")
# signature, version, index, grids, size, name, matrix, translation, world box, voxel size, class,
# type
_BUFFER = Struct("<8s8xI4xIIQ256s88x9d72x3d8x6d3dII32x")
_TREE = Struct("<24xQ24xQ")
_ROOT = Struct("<6i")
_LENGTH = Struct("<Q")

# Named as in OpenVDB, if it has the type.
_TYPES = dict(
    enumerate(
        (
            *("unknown", "float", "double", "int16", "int32", "int64", "vec3s", "vec3d", "mask"),
            *("half", "uint32", "bool", "rgba8", "float", "float", "float", "float", "vec4s"),
            *("vec4d", "index", "onindex", "indexmask", "onindexmask", "ptidx32", "vec3u8"),
            *("vec3u16", "uint8"),
        )
    )
)
_QUANTIZED = {13: "Fp4", 14: "Fp8", 15: "Fp16", 16: "FpN"}
_CLASSES = {1: "level set", 2: "fog volume", 3: "staggered"}


def read_nvdb(window: Window) -> VolumeFile:
    """Reads a file from the start of its window; the signature was checked by the caller."""
    reader = _Reader(window)
    try:
        if window.peek(len(_BARE)) == _BARE:
            reader.read_buffers()
        else:
            reader.read_segments()
    except VolumeFileError as error:
        partial = reader.result(finished=False) if reader.version is not None else None
        if reader.newer is None or error.code == "not-a-file":
            error.partial = partial
            raise
        message = f"{reader.newer}: {error.message}"
        raise VolumeFileError("version-unsupported", message, error.offset, partial) from None
    return reader.result(finished=True)


class _Reader:
    """Reads one file; its attributes are what is known so far."""

    def __init__(self, window: Window) -> None:
        self.window = window
        self.version: int | None = None
        self.grid_count = 0
        self.grids: list[Grid] = []
        self.newer: str | None = None

    def result(self, *, finished: bool) -> VolumeFile:
        return VolumeFile(
            format="nanovdb",
            version=_dotted(self.version),
            version_number=self.version or 0,
            grids=tuple(self.grids),
            newer=self.newer,
            grid_count=self.grid_count,
            complete=finished,
        )

    def read_segments(self) -> None:
        """Reads segments: a header, then entry and name of each grid, then the grids."""
        window = self.window
        segments = 0
        while self.version is None or self.has_segment():
            at = window.position
            segments += 1
            if segments > _MOST:
                raise invalid(f"more than {_MOST} segments", at)
            signature, version, count, _ = window.unpack(_SEGMENT)
            if signature not in NANOVDB or signature == _BARE:
                raise invalid("no segment where one should begin", at)
            self.take_version(version, at)
            self.count_grids(count)
            window.require(count * _ENTRY.size)
            entries = [self.read_entry() for _ in range(count)]
            for name, entry in entries:
                self.read_segment_grid(name, entry)

    def has_segment(self) -> bool:
        """Whether another segment follows: NanoVDB ignores a few other bytes at the end."""
        rest = self.window.peek(_SEGMENT.size)
        signature = rest[: len(_BARE)]
        is_start = bool(signature) and any(word.startswith(signature) for word in NANOVDB)
        return len(rest) == _SEGMENT.size or is_start

    def take_version(self, version: int, at: int) -> None:
        major = version >> 21
        if not _may_be(version):
            raise invalid(f"no NanoVDB writes version {_dotted(version)}", at + len(_BARE))
        if major < MAJOR_VERSION:
            self.version = self.version or version
            raise VolumeFileError(
                "version-unsupported",
                f"NanoVDB {_dotted(version)} is older than {MAJOR_VERSION}, "
                "which NanoVDB no longer reads",
                at + len(_BARE),
            )
        if self.version is None and major > MAJOR_VERSION:
            self.newer = f"NanoVDB {_dotted(version)} is newer than {MAJOR_VERSION}"
        self.version = self.version or version

    def count_grids(self, count: int) -> None:
        self.grid_count += count
        if self.grid_count > _MOST:
            raise invalid(f"{self.grid_count} grids", self.window.position)

    def read_entry(self) -> tuple[str, tuple[Any, ...]]:
        window = self.window
        entry = window.unpack(_ENTRY)
        length = entry[20]
        if length > _LONGEST_NAME:
            raise invalid(f"a grid's name of {length} bytes", window.position)
        return _name(window.read(length)), entry

    def read_segment_grid(self, name: str, entry: tuple[Any, ...]) -> None:
        window = self.window
        _, size, voxels, kind, grid_class = entry[:5]
        world, index, voxel_size, codec = entry[5:11], entry[11:17], entry[17:20], entry[21]
        start = window.position
        end = start + size
        bounds: IndexBounds = (index[:3], index[3:])
        head = self.read_head(codec, size)
        transform = _transform(head, start) if head else _aligned(bounds, world, voxel_size)
        metadata = _metadata(voxels, voxel_size, world)
        self.grids.append(_grid(name, kind, grid_class, bounds, transform, metadata))
        self.skip_grid(end)

    def read_head(self, codec: int, size: int) -> bytes | None:
        """A grid's own header, which has its transform; None if it can't be decompressed."""
        window = self.window
        start = window.position
        head = b""
        if codec == _NONE and size >= _BUFFER.size:
            head = window.peek(_BUFFER.size)
        elif codec == _ZIP and size > _LENGTH.size:
            packed = window.peek(min(size, _ZIPPED_HEAD))[_LENGTH.size :]
            try:
                head = zlib.decompressobj().decompress(packed, _BUFFER.size)
            except zlib.error:
                return None
        window.position = start
        return head if len(head) == _BUFFER.size and head[:8] in NANOVDB else None

    def read_buffers(self) -> None:
        """Reads grid buffers, which follow each other; the first one has their number."""
        window = self.window
        while self.version is None or len(self.grids) < self.grid_count:
            start = window.position
            head = window.read(_BUFFER.size)
            fields = _BUFFER.unpack(head)
            signature, version, _, count, size, name = fields[:6]
            world, voxel_size, (grid_class, kind) = fields[18:24], fields[24:27], fields[27:]
            if signature != _BARE:
                raise invalid("no grid where one should begin", start)
            if self.version is None:
                self.take_version(version, start + 8)
                self.count_grids(max(1, count))
                window.require((self.grid_count - 1) * _BUFFER.size)
            root, voxels = window.unpack(_TREE)
            # The offset of the root counts from the start of the tree.
            root += start + _BUFFER.size
            if size < _BUFFER.size + _TREE.size or root > start + size:
                raise invalid(f"grid {quoted_short(_name(name))} of {size} bytes", start)
            window.position = root
            index = window.unpack(_ROOT)
            bounds: IndexBounds = (index[:3], index[3:])
            transform = _transform(head, start)
            metadata = _metadata(voxels, voxel_size, world)
            self.grids.append(_grid(_name(name), kind, grid_class, bounds, transform, metadata))
            self.skip_grid(start + size)

    def skip_grid(self, end: int) -> None:
        """Moves to the end of the last grid, past its voxels."""
        window = self.window
        if end > window.size:
            label = quoted_short(self.grids[-1].label)
            message = f"grid {label} ends at byte {end}, the file at {window.size}"
            raise VolumeFileError("truncated", message, window.size)
        window.position = end


def _grid(
    name: str,
    kind: int,
    grid_class: int,
    bounds: IndexBounds,
    transform: Transform | None,
    metadata: Mapping[str, Metadatum],
) -> Grid:
    is_empty = any(low > high for low, high in zip(*bounds, strict=True))
    value_type = _TYPES.get(kind, "unknown")
    return Grid(
        name=name,
        unique_name=name,
        value_type=value_type,
        tree_type=_QUANTIZED.get(kind, value_type),
        grid_class=_CLASSES.get(grid_class, "unknown"),
        index_bounds=None if is_empty else bounds,
        is_empty=is_empty,
        transform=transform,
        metadata=metadata,
    )


def _metadata(voxels: int, voxel_size: Point, world: tuple[float, ...]) -> Mapping[str, Metadatum]:
    """Values of a grid's header as metadata, of which NanoVDB has none."""
    return {
        "voxel_count": Metadatum("uint64", voxels, 8),
        "voxel_size": Metadatum("vec3d", voxel_size, 24),
        "world_bbox_min": Metadatum("vec3d", world[:3], 24),
        "world_bbox_max": Metadatum("vec3d", world[3:], 24),
    }


def _may_be(version: int) -> bool:
    """Whether there may be a version; the first ones may have stood there unpacked, as `28`."""
    return 0 < version < MAJOR_VERSION or 1 <= version >> 21 <= _LAST_MAJOR


def _dotted(version: int | None) -> str:
    packed = version or 0
    return f"{packed >> 21}.{packed >> 10 & 0x7FF}.{packed & 0x3FF}"


def _name(stored: bytes) -> str:
    return stored.partition(b"\0")[0].decode("utf-8", "surrogateescape")


def _transform(head: bytes, at: int) -> Transform:
    fields = _BUFFER.unpack(head)
    a, b, c, d, e, f, g, h, i = fields[6:15]
    x, y, z = fields[15:18]
    if not finite(fields[6:18]):
        raise invalid("the grid's map holds numbers that are not finite", at)
    # NanoVDB multiplies a matrix by a column vector, USD a row vector by a matrix.
    return Transform("Map", ((a, d, g, 0.0), (b, e, h, 0.0), (c, f, i, 0.0), (x, y, z, 1.0)))


def _aligned(bounds: IndexBounds, world: tuple[float, ...], voxel_size: Point) -> Transform | None:
    """The transform from index box to world box, if one that scales and translates fits.

    The world box reaches to the index after the last voxel.
    """
    if not finite((*world, *voxel_size)):
        return None
    low, high = bounds
    world_bounds: Bounds = (world[:3], world[3:])  # type: ignore[assignment]
    for first, last, start, end, size in zip(low, high, *world_bounds, voxel_size, strict=True):
        length = (last - first + 1) * size
        if last < first or abs(end - start - length) > 1e-5 * max(abs(start), abs(end), length):
            return None
    translation = [
        start - first * size for first, start, size in zip(low, world[:3], voxel_size, strict=True)
    ]
    return Transform("Map", scale_translate(voxel_size, translation))
