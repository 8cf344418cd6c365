"""OpenVDB: file versions 222 to 225, which differ in nothing that is read here."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from itertools import chain
from operator import gt
from struct import Struct
from typing import Final

from usdvol_lint.volumefile.model import (
    Grid,
    IndexBounds,
    MetadataValue,
    Metadatum,
    VolumeFile,
    VolumeFileError,
    invalid,
    quoted,
)
from usdvol_lint.volumefile.signatures import OPENVDB
from usdvol_lint.volumefile.transform import (
    Frustum,
    Matrix,
    Transform,
    finite,
    rows,
    scale_translate,
)
from usdvol_lint.volumefile.window import Window

OLDEST_VERSION: Final = 222
NEWEST_VERSION: Final = 225

_LONGEST_NAME = 1 << 16
_LONGEST_TYPE = 1 << 10
_LONGEST_MAP = 1 << 8
_LARGEST_VALUE = 1 << 20
_MOST = 100_000
_SMALLEST_METADATUM = 12
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

_BOUNDS = ("file_bbox_min", "file_bbox_max")

_U32 = Struct("<I")
_VERSION = Struct("<I")
_HEADER = Struct("<IIB36s")
_GRID_COUNT = Struct("<i")
_OFFSETS = Struct("<qqq")
_VALUES = {
    "bool": Struct("<?"),
    "int32": Struct("<i"),
    "int64": Struct("<q"),
    "float": Struct("<f"),
    "double": Struct("<d"),
    "ptidx32": Struct("<I"),
    "ptidx64": Struct("<Q"),
    **{
        f"vec{length}{letter}": Struct(f"<{length}{code}")
        for length in (2, 3, 4)
        for letter, code in (("i", "i"), ("s", "f"), ("d", "d"))
    },
    "mat4s": Struct("<16f"),
    "mat4d": Struct("<16d"),
}

_FRUSTUM = Struct("<8d")
_FRUSTUM_MAP = "NonlinearFrustumMap"
# After scale and translation come values derived of them, which nobody needs.
_SCALE = Struct("<3d96x"), scale_translate
_TRANSLATE_SCALE = Struct("<6d96x"), lambda numbers: scale_translate(numbers[3:], numbers[:3])
_MAPS: dict[str, tuple[Struct, Callable[[tuple[float, ...]], Matrix]]] = {
    "AffineMap": (Struct("<16d"), rows),
    "UnitaryMap": (Struct("<16d"), rows),
    "ScaleMap": _SCALE,
    "UniformScaleMap": _SCALE,
    "ScaleTranslateMap": _TRANSLATE_SCALE,
    "UniformScaleTranslateMap": _TRANSLATE_SCALE,
    "TranslationMap": (Struct("<3d"), lambda numbers: scale_translate((1, 1, 1), numbers)),
}


def read_vdb(window: Window) -> VolumeFile:
    """The file that starts at the window's start, whose signature is known to be right."""
    reader = _Reader(window)
    try:
        reader.read()
    except VolumeFileError as error:
        partial = reader.result(finished=False) if reader.version else None
        if reader.newer is None or error.code == "not-a-file":
            error.partial = partial
            raise
        raise VolumeFileError(
            "version-unsupported",
            f"{reader.newer}: {error.message}",
            error.offset,
            partial,
        ) from None
    return reader.result(finished=True)


class _Reader:
    """What is known so far; each method reads one thing at the window's position."""

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
        self.metadata = self.read_metadata()
        at = self.window.position
        (count,) = self.window.unpack(_GRID_COUNT)
        if not 0 <= count <= _MOST:
            raise invalid(f"{count} grids", at)
        self.window.require(count * _SMALLEST_DESCRIPTOR)
        self.grid_count = count
        for _ in range(min(count, 1) if self.streamed else count):
            self.read_grid()

    def read_header(self) -> None:
        window = self.window
        window.skip(len(OPENVDB))
        (self.version,) = window.unpack(_VERSION)
        if self.version < OLDEST_VERSION:
            raise VolumeFileError(
                "version-unsupported",
                f"file version {self.version} is older than {OLDEST_VERSION}, "
                "which OpenVDB no longer reads",
                len(OPENVDB),
            )
        if self.version > NEWEST_VERSION:
            self.newer = f"file version {self.version} is newer than {NEWEST_VERSION}"
        major, minor, has_offsets, uuid = window.unpack(_HEADER)
        window.note("uuid", len(uuid))
        self.library = f"{major}.{minor}"
        self.streamed = not has_offsets
        # OpenVDB leaves a NUL where it found no randomness.
        self.uuid = uuid.partition(b"\0")[0].decode("ascii", "surrogateescape") or None

    def read_metadata(self) -> dict[str, Metadatum]:
        window = self.window
        at = window.position
        (count,) = window.unpack(_U32)
        if count > _MOST:
            raise invalid(f"{count} metadata entries", at)
        window.require(count * _SMALLEST_METADATUM)
        found: dict[str, Metadatum] = {}
        for _ in range(count):
            at = window.position
            name = window.string(_LONGEST_NAME)
            if not name:
                raise invalid("metadata without a name", at)
            kind = window.string(_LONGEST_TYPE)
            (size,) = window.unpack(_U32)
            value = self.read_value(kind, size)
            if kind in _VALUES and kind != "bool":
                window.note(name if kind == "vec3i" and name in _BOUNDS else "number", size)
            elif kind not in ("bool", "string"):
                window.note("skipped", size)
            if not kind.startswith("__"):
                found[name] = Metadatum(kind, value, size)
        return found

    def read_value(self, kind: str, size: int) -> MetadataValue:
        window = self.window
        form = _VALUES.get(kind)
        if form is not None:
            if size != form.size:
                message = f"{size} bytes of {kind}, which takes {form.size}"
                raise invalid(message, window.position - _U32.size)
            values: tuple[float, ...] = window.unpack(form)
            return values if len(values) > 1 else values[0]
        if kind == "string" and size <= _LARGEST_VALUE:
            return window.read(size).decode("utf-8", "surrogateescape")
        window.skip(size)
        return None

    def read_grid(self) -> None:
        window = self.window
        full_name = window.string(_LONGEST_NAME)
        stored_type = window.string(_LONGEST_TYPE)
        parent = window.string(_LONGEST_NAME)
        unique_name, mark, suffix = full_name.partition(_SUFFIX_MARK)
        end = self.enter_grid(unique_name, is_instance=bool(parent))

        window.skip(_U32.size)  # compression flags
        metadata = self.read_metadata()
        transform = self.read_transform()
        window.note("head", 0)

        tree_type = stored_type.removesuffix(_HALF_MARK)
        bounds = _index_bounds(metadata)
        is_empty = bounds is not None and any(map(gt, *bounds))
        position = len(self.grids)
        grid = Grid(
            name=_text(metadata, "name"),
            unique_name=unique_name,
            suffix=suffix if mark else None,
            value_type=_value_type(tree_type),
            tree_type=tree_type,
            half=tree_type != stored_type or _saved_as_half(metadata),
            registered=tree_type in _REGISTERED,
            grid_class=_known(_text(metadata, "class"), CLASSES, "unknown"),
            vector_type=_known(_text(metadata, "vector_type"), VECTOR_TYPES, "invariant"),
            index_bounds=None if is_empty else bounds,
            is_empty=is_empty,
            transform=transform,
            metadata=metadata,
        )
        self.grids.append(grid)
        self.parents.setdefault(full_name, position)
        if parent:
            self.instances[position] = parent

        window.limit = window.size
        if end > window.size:
            message = f"grid {quoted(grid.label)} ends at byte {end}, the file at {window.size}"
            raise VolumeFileError("truncated", message, window.size)
        if not self.streamed:
            window.position = end

    def enter_grid(self, name: str, *, is_instance: bool) -> int:
        """Goes to a grid's metadata, narrows the window to it, and says where the grid ends."""
        window = self.window
        at = window.position
        grid_start, blocks, end = window.unpack(_OFFSETS)
        window.note("offsets", _OFFSETS.size)
        if self.streamed:
            return 0
        section_end = end if is_instance else blocks
        if not window.position <= grid_start <= section_end <= end:
            message = f"grid {quoted(name)} has offsets {grid_start}, {blocks}, {end}"
            raise invalid(message, at)
        window.position = grid_start
        window.limit = min(section_end, window.size)
        return int(end)

    def read_transform(self) -> Transform:
        window = self.window
        at = window.position
        kind = window.string(_LONGEST_MAP)
        if kind != _FRUSTUM_MAP:
            return Transform(kind, self.read_linear_map(kind, at))
        numbers = window.unpack(_FRUSTUM)
        frustum = Frustum(numbers[0:3], numbers[3:6], numbers[6], numbers[7])
        if not frustum.valid:
            raise invalid("a frustum without extent, or of no finite size", at)
        at = window.position
        return Transform(kind, self.read_linear_map(window.string(_LONGEST_MAP), at), frustum)

    def read_linear_map(self, kind: str, at: int) -> Matrix:
        if kind not in _MAPS:
            raise invalid(f"unknown transform {quoted(kind)}", at)
        form, matrix_of = _MAPS[kind]
        matrix = matrix_of(self.window.unpack(form))
        if not finite(chain.from_iterable(matrix)):
            raise invalid(f"the {kind} holds numbers that are not finite", at)
        return matrix

    def share_bounds(self) -> None:
        """Gives instances, which have no bounds of their own, those of the grid they show."""
        for position, parent_name in self.instances.items():
            parent = self.parents.get(parent_name)
            grid = self.grids[position]
            if parent is not None and grid.index_bounds is None and not grid.is_empty:
                self.grids[position] = grid._replace(
                    index_bounds=self.grids[parent].index_bounds,
                    is_empty=self.grids[parent].is_empty,
                )


def _text(metadata: dict[str, Metadatum], name: str) -> str:
    entry = metadata.get(name)
    return entry.value if entry is not None and isinstance(entry.value, str) else ""


def _saved_as_half(metadata: Mapping[str, Metadatum]) -> bool:
    entry = metadata.get("is_saved_as_half_float")
    return entry is not None and entry.value is True


def _known(text: str, words: frozenset[str], otherwise: str) -> str:
    word = text.strip().lower()
    return word if word in words else otherwise


def _index_bounds(metadata: dict[str, Metadatum]) -> IndexBounds | None:
    low, high = map(metadata.get, _BOUNDS)
    if low is None or high is None or not low.type == high.type == "vec3i":
        return None
    return low.value, high.value  # type: ignore[return-value]


def _value_type(tree_type: str) -> str:
    """`float` of `Tree_float_5_4_3`; other forms are left as they are."""
    words = tree_type.split("_")
    while len(words) > 2 and words[-1].isdigit():
        words.pop()
    return "_".join(words[1:]) if words[0] == "Tree" and len(words) > 1 else tree_type
