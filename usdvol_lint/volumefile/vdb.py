"""OpenVDB: file versions 222 to 225, between which nothing that is read here has changed."""

from __future__ import annotations

from collections.abc import Mapping
from operator import gt
from struct import Struct
from typing import Final

from usdvol_lint.volumefile.model import (
    Grid,
    Metadatum,
    VolumeFile,
    VolumeFileError,
    invalid,
    quoted_short,
)
from usdvol_lint.volumefile.signatures import OPENVDB
from usdvol_lint.volumefile.transform import Transform
from usdvol_lint.volumefile.vdb_maps import read_transform
from usdvol_lint.volumefile.vdb_metadata import (
    LONGEST_NAME,
    LONGEST_TYPE,
    MOST,
    flag,
    index_bounds,
    read_metadata,
    text,
)
from usdvol_lint.volumefile.window import Window

OLDEST_VERSION: Final = 222
NEWEST_VERSION: Final = 225
_EVER = frozenset((1, 2, *range(211, 1000)))
"""What a file version may be: of those before 211 the first of three numbers is read.

They are counted up, so that one with more than three digits will not come.
"""

_SMALLEST_DESCRIPTOR = 36

_SUFFIX_MARK = "\x1e"
_HALF_MARK = "_HalfFloat"
_REGISTERED = frozenset(
    f"Tree_{value}_5_4_3"
    for value in (
        *("half", "float", "double", "int32", "int64", "bool", "mask"),
        *("vec3i", "vec3s", "vec3d", "ptidx32", "ptdataidx32"),
    )
)
CLASSES = frozenset(("level set", "fog volume", "staggered"))
VECTOR_TYPES = frozenset(
    (
        "covariant",
        "covariant normalize",
        "contravariant relative",
        "contravariant absolute",
    )
)

_VERSION = Struct("<I")
_HEADER = Struct("<IIB36s")
_GRID_COUNT = Struct("<i")
_OFFSETS = Struct("<qqq")
_COMPRESSION_FLAGS = 4


def read_vdb(window: Window) -> VolumeFile:
    """Reads a file from the start of its window; the signature was checked by the caller."""
    reader = _Reader(window)
    try:
        reader.read()
    except VolumeFileError as error:
        partial = reader.result(finished=False) if reader.version else None
        if reader.newer is None or error.code == "not-a-file":
            error.partial = partial
            raise
        message = f"{reader.newer}: {error.message}"
        raise VolumeFileError("version-unsupported", message, error.offset, partial) from None
    return reader.result(finished=True)


class _Reader:
    """Reads one file; its attributes are what is known so far.

    `parents` are the positions of grids by full name, `instances` the full names of the grids that
    others show, by the position of these.
    """

    def __init__(self, window: Window) -> None:
        self.window = window
        self.version = 0
        self.library: str | None = None
        self.uuid: str | None = None
        self.streamed = False
        self.metadata: dict[str, Metadatum] = {}
        self.grid_count = 0
        self.grids: list[Grid] = []
        self.newer: str | None = None
        self.parents: dict[str, int] = {}
        self.instances: dict[int, str] = {}

    def result(self, *, finished: bool) -> VolumeFile:
        self.share_bounds()
        return VolumeFile(
            format="openvdb",
            version=str(self.version),
            version_number=self.version,
            library=self.library,
            uuid=self.uuid,
            metadata=self.metadata,
            grids=tuple(self.grids),
            newer=self.newer,
            grid_count=self.grid_count,
            streamed=self.streamed,
            complete=finished and len(self.grids) == self.grid_count,
        )

    def read(self) -> None:
        self.read_header()
        self.metadata = read_metadata(self.window)
        at = self.window.position
        (count,) = self.window.unpack(_GRID_COUNT)
        if not 0 <= count <= MOST:
            raise invalid(f"{count} grids", at)
        self.window.require(count * _SMALLEST_DESCRIPTOR)
        self.grid_count = count
        for _ in range(min(count, 1) if self.streamed else count):
            self.read_grid()

    def read_header(self) -> None:
        window = self.window
        window.skip(len(OPENVDB))
        (version,) = window.unpack(_VERSION)
        if version not in _EVER:
            raise invalid(f"no OpenVDB writes file version {version}", len(OPENVDB))
        self.version = version
        if self.version < OLDEST_VERSION:
            raise VolumeFileError(
                "version-unsupported",
                f"file version {self.version} is older than {OLDEST_VERSION}, "
                "which OpenVDB 13.0 no longer reads",
                len(OPENVDB),
            )
        if self.version > NEWEST_VERSION:
            self.newer = f"file version {self.version} is newer than {NEWEST_VERSION}"
        major, minor, has_offsets, uuid = window.unpack(_HEADER)
        window.note("uuid", len(uuid))
        self.library = f"{major}.{minor}"
        self.streamed = not has_offsets
        # OpenVDB writes NULs if it has no source of randomness.
        self.uuid = uuid.partition(b"\0")[0].decode("ascii", "surrogateescape") or None

    def read_grid(self) -> None:
        window = self.window
        full_name = window.string(LONGEST_NAME)
        stored_type = window.string(LONGEST_TYPE)
        parent = window.string(LONGEST_NAME)
        end = self.enter_grid(full_name, is_instance=bool(parent))
        window.skip(_COMPRESSION_FLAGS)
        metadata = read_metadata(window)
        transform = read_transform(window)
        window.note("head", 0)

        grid = _grid(full_name, stored_type, metadata, transform)
        position = len(self.grids)
        self.grids.append(grid)
        self.parents.setdefault(full_name, position)
        if parent:
            self.instances[position] = parent

        window.limit = window.size
        if end > window.size:
            message = (
                f"grid {quoted_short(grid.label)} ends at byte {end}, the file at {window.size}"
            )
            raise VolumeFileError("truncated", message, window.size)
        if not self.streamed:
            window.position = end

    def enter_grid(self, full_name: str, *, is_instance: bool) -> int:
        """Moves to a grid's metadata, limits the window to the head, and returns the grid's end."""
        window = self.window
        at = window.position
        grid_start, blocks, end = window.unpack(_OFFSETS)
        window.note("offsets", _OFFSETS.size)
        if self.streamed:
            return 0
        section_end = end if is_instance else blocks
        if not window.position <= grid_start <= section_end <= end:
            name = quoted_short(full_name.partition(_SUFFIX_MARK)[0])
            offsets = f"{grid_start}, {blocks}, {end}"
            message = f"the offsets of grid {name}, {offsets}, do not follow each other"
            raise invalid(message, at)
        window.position = grid_start
        window.limit = min(section_end, window.size)
        return int(end)

    def share_bounds(self) -> None:
        """Gives instances, which have no bounds of their own, those of the grid that they show."""
        for position, parent_name in self.instances.items():
            parent = self.parents.get(parent_name)
            grid = self.grids[position]
            if parent is not None and grid.index_bounds is None and not grid.is_empty:
                self.grids[position] = grid._replace(
                    index_bounds=self.grids[parent].index_bounds,
                    is_empty=self.grids[parent].is_empty,
                )


def _grid(
    full_name: str, stored_type: str, metadata: Mapping[str, Metadatum], transform: Transform
) -> Grid:
    unique_name, mark, suffix = full_name.partition(_SUFFIX_MARK)
    tree_type = stored_type.removesuffix(_HALF_MARK)
    bounds = index_bounds(metadata)
    is_empty = bounds is not None and any(map(gt, *bounds))
    return Grid(
        name=text(metadata, "name"),
        unique_name=unique_name,
        suffix=suffix if mark else None,
        value_type=_value_type(tree_type),
        tree_type=tree_type,
        half=tree_type != stored_type or flag(metadata, "is_saved_as_half_float"),
        registered=tree_type in _REGISTERED,
        grid_class=_known(text(metadata, "class"), CLASSES, "unknown"),
        vector_type=_known(text(metadata, "vector_type"), VECTOR_TYPES, "invariant"),
        index_bounds=None if is_empty else bounds,
        is_empty=is_empty,
        transform=transform,
        metadata=metadata,
    )


def _known(stored: str, words: frozenset[str], otherwise: str) -> str:
    word = stored.strip().lower()
    return word if word in words else otherwise


def _value_type(tree_type: str) -> str:
    """`float` for `Tree_float_5_4_3`; a type of another form as it is."""
    words = tree_type.split("_")
    while len(words) > 2 and words[-1].isdigit():
        words.pop()
    return "_".join(words[1:]) if words[0] == "Tree" and len(words) > 1 else tree_type
