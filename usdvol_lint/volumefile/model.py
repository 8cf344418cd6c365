"""What the readers of volume files return, and the error that they raise."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final, Literal, NamedTuple, TypeAlias

from usdvol_lint.volumefile.transform import Bounds, Matrix, Transform, finite
from usdvol_lint.words import quoted

Format: TypeAlias = Literal["openvdb", "nanovdb", "field3d"]
ErrorCode: TypeAlias = Literal[
    "not-a-file",
    "not-a-volume-file",
    "truncated",
    "version-unsupported",
    "needs-h5py",
]
MetadataValue: TypeAlias = bool | int | float | str | tuple[int, ...] | tuple[float, ...] | None
Coordinate: TypeAlias = tuple[int, int, int]
IndexBounds: TypeAlias = tuple[Coordinate, Coordinate]

BOUNDS_NAMES: Final = ("file_bbox_min", "file_bbox_max")
"""The entries of OpenVDB's metadata with the lowest and the highest voxel of a grid."""

_LONGEST_QUOTE = 80


class Metadatum(NamedTuple):
    """One entry of a file's or a grid's metadata.

    `value` is None for types that the reader doesn't know and for values that are too large.
    `size` is in bytes; no rule reads it, but the tests compare it with what OpenVDB's own tools
    say, as proof that the reader advanced by the right number of bytes.
    """

    type: str
    value: MetadataValue
    size: int


_NONE: Mapping[str, Metadatum] = {}
"""No metadata; not a MappingProxyType, which can't be pickled."""


class Grid(NamedTuple):
    """One grid, or one Field3D layer.

    `name` is that of the metadata, `unique_name` that of the descriptor without its suffix, by
    which OpenVDB finds grids; in NanoVDB and Field3D they are the same.
    `suffix` tells grids of the same name apart on disk.
    `purpose` is Field3D's partition, what `fieldPurpose` names.
    `value_type` is spelt as in OpenVDB, `tree_type` as in the file.
    `half`: values are stored in half precision.
    `registered`: the type is one of OpenVDB's own.
    `index_bounds` are inclusive, and None where the file holds none or the grid is empty; an
    instance has those of the grid whose voxels it shows.
    """

    name: str
    unique_name: str
    value_type: str
    tree_type: str
    suffix: str | None = None
    purpose: str | None = None
    half: bool = False
    registered: bool = True
    grid_class: str = "unknown"
    vector_type: str = "invariant"
    index_bounds: IndexBounds | None = None
    is_empty: bool = False
    transform: Transform | None = None
    metadata: Mapping[str, Metadatum] = _NONE

    @property
    def label(self) -> str:
        """The name as OpenVDB's tools print it: `density[1]` if others have the same name."""
        return self.unique_name if self.suffix is None else f"{self.unique_name}[{self.suffix}]"

    @property
    def is_unmeasured(self) -> bool:
        """Whether it may have voxels, and the file does not tell where they are."""
        return not self.is_empty and (self.index_bounds is None or self.transform is None)

    def world_bounds(self, padding: float = 0.0, then: Matrix | None = None) -> Bounds | None:
        """The box around the centres of the active voxels, widened by `padding` voxels.

        It is in world space, or in the space that the matrix `then` leads to from there.
        None if the grid is empty, its bounds or transform are unknown, or numbers overflow.
        """
        if self.index_bounds is None or self.transform is None:
            return None
        (x, y, z), (u, v, w) = self.index_bounds
        transform = self.transform if then is None else self.transform.then(then)
        bounds = transform.bounds(
            (x - padding, y - padding, z - padding), (u + padding, v + padding, w + padding)
        )
        return bounds if finite((*bounds[0], *bounds[1])) else None


class VolumeFile(NamedTuple):
    """A volume file; `grids` are in file order.

    `version` is the file format's (OpenVDB's `224`, NanoVDB's `32.4.2`, Field3D's `1.7.3`), and
    `version_number` the same as one ordered number; `library` is the OpenVDB that wrote the file.
    `newer` is a message if the version is newer than any that the reader knows.
    `grid_count` is the number in the header.
    `complete` is False if the reader was stopped by an error or `grids` are fewer: of a `streamed`
    file only the first grid can be found without decoding voxels.
    No rule reads `library`, `uuid`, `streamed` and the metadata: the tests compare them with what
    OpenVDB's own tools say, since a reader that misplaces one of them misplaces all that follows.
    """

    format: Format
    version: str
    version_number: int
    library: str | None = None
    uuid: str | None = None
    metadata: Mapping[str, Metadatum] = _NONE
    grids: tuple[Grid, ...] = ()
    newer: str | None = None
    grid_count: int = 0
    streamed: bool = False
    complete: bool = True


class Fault(NamedTuple):
    """Why a file can't be read, or not to its end, or was not read.

    `code` is an `ErrorCode` or a reason of the caller's own for not reading the file.
    `offset` counts from the start of the volume file, which may lie inside a package.
    """

    code: str
    message: str
    offset: int | None = None

    def __str__(self) -> str:
        return self.message if self.offset is None else f"{self.message} (at byte {self.offset})"


class VolumeFileError(Exception):
    """Why a file can't be read, or not to its end; see `Fault`.

    `partial` is what was understood before, if anything was.
    """

    def __init__(
        self,
        code: ErrorCode,
        message: str,
        offset: int | None = None,
        partial: VolumeFile | None = None,
    ) -> None:
        super().__init__(code, message, offset, partial)
        self.code: ErrorCode = code
        self.message = message
        self.offset = offset
        self.partial = partial

    @property
    def fault(self) -> Fault:
        """What may outlive the error, which holds on to its traceback."""
        return Fault(self.code, self.message, self.offset)

    def __str__(self) -> str:
        return str(self.fault)


def invalid(message: str, offset: int) -> VolumeFileError:
    """The error for bytes that no writer of the format writes."""
    return VolumeFileError("not-a-volume-file", message, offset)


def quoted_short(text: str) -> str:
    """Text from a file in quotes, printable and cut off after 80 characters."""
    return quoted(text if len(text) <= _LONGEST_QUOTE else text[:_LONGEST_QUOTE] + "…")
