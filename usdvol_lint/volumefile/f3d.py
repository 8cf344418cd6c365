"""Field3D: layers in partitions, in an Ogawa or an HDF5 container."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Final

from usdvol_lint.volumefile.model import (
    Grid,
    IndexBounds,
    MetadataValue,
    Metadatum,
    VolumeFile,
    VolumeFileError,
    quoted_short,
)
from usdvol_lint.volumefile.transform import (
    IDENTITY,
    Matrix,
    Transform,
    finite,
    multiply,
    rows,
    scale_translate,
)

LARGEST_VALUE: Final = 1 << 20
"""In bytes; larger values are skipped."""
DEEPEST: Final = 4
"""Levels of groups that are read: root, partition, layer and its metadata."""
MOST: Final = 100_000
"""More groups and attributes than any writer writes."""

_VALUE_TYPES: dict[tuple[MetadataValue, MetadataValue], str] = {
    (components, bits): name
    for components, names in ((1, ("half", "float", "double")), (3, ("vec3h", "vec3s", "vec3d")))
    for bits, name in zip((16, 32, 64), names, strict=True)
}


@dataclass(slots=True)
class Group:
    """A group of an Ogawa or HDF5 file, without its data sets."""

    name: str
    attributes: dict[str, Metadatum] = field(default_factory=dict)
    groups: list[Group] = field(default_factory=list)

    def value(self, name: str) -> MetadataValue:
        entry = self.attributes.get(name)
        return None if entry is None else entry.value

    def group(self, name: str) -> Group | None:
        return next((group for group in self.groups if group.name == name), None)


def volume_file(root: Group) -> VolumeFile:
    """The Field3D file in a container; raises VolumeFileError if it is not one."""
    version = root.value("version_number")
    if not (isinstance(version, tuple) and len(version) == 3 and finite(version)):
        raise VolumeFileError("not-a-volume-file", "the container holds no Field3D")
    major, minor, patch = map(int, version)
    grids: list[Grid] = []
    for partition in root.groups:
        if partition.value("is_field3d_partition") != "1":
            continue
        purpose = _purpose(partition.name)
        mapping = _mapping(partition)
        for layer in partition.groups:
            if layer.value("class_type") != "field3d_layer":
                continue
            grids.append(_grid(layer, purpose, mapping))
    return VolumeFile(
        format="field3d",
        version=f"{major}.{minor}.{patch}",
        version_number=major * 10_000 + minor * 100 + patch,
        grids=tuple(grids),
        grid_count=len(grids),
    )


def _purpose(partition: str) -> str:
    """`cloud` of `cloud.1`: Field3D numbers partitions of one name with different mappings."""
    name, dot, number = partition.rpartition(".")
    return name if dot and number.isdigit() else partition


def _mapping(partition: Group) -> tuple[str, Matrix] | None:
    """Type and matrix of the mapping from a partition's unit cube to world space.

    None for a mapping that is no matrix; of an animated one the first sample.
    """
    mapping = partition.group("mapping")
    kind = mapping.value("mapping_type") if mapping else None
    if mapping is None or kind == "NullFieldMapping":
        return "NullFieldMapping", IDENTITY
    numbers = mapping.value("matrix_0")
    if kind != "MatrixFieldMapping" or not isinstance(numbers, tuple) or len(numbers) != 16:
        return None
    if not finite(numbers):
        message = f"the mapping of partition {quoted_short(partition.name)} is not finite"
        raise VolumeFileError("not-a-volume-file", message)
    return "MatrixFieldMapping", rows(numbers)


def _grid(layer: Group, purpose: str, mapping: tuple[str, Matrix] | None) -> Grid:
    components, bits = layer.value("components"), layer.value("bits_per_component")
    extents, window = _box(layer, "extents"), _box(layer, "data_window")
    user = layer.group("metadata")
    return Grid(
        name=layer.name,
        unique_name=layer.name,
        purpose=purpose,
        value_type=_VALUE_TYPES.get((components, bits), "unknown"),
        tree_type=str(layer.value("class_name") or "unknown"),
        index_bounds=_overlap(extents, window),
        transform=_transform(mapping, extents),
        metadata=(user.attributes if user else {}) | layer.attributes,
    )


def _box(layer: Group, name: str) -> IndexBounds | None:
    """A box that HDF5 stores as one attribute, Ogawa as two; None if invalid or missing."""
    corners = layer.value(name)
    if corners is None:
        low, high = layer.value(f"{name}_min"), layer.value(f"{name}_max")
        corners = low + high if isinstance(low, tuple) and isinstance(high, tuple) else None
    if not (isinstance(corners, tuple) and len(corners) == 6 and finite(corners)):
        return None
    x, y, z, u, v, w = map(int, corners)
    return ((x, y, z), (u, v, w)) if x <= u and y <= v and z <= w else None


def _overlap(extents: IndexBounds | None, window: IndexBounds | None) -> IndexBounds | None:
    """The voxels of the data window within the extents; the extents if there are none."""
    if extents is None or window is None:
        return extents or window
    x, y, z = map(max, extents[0], window[0])
    u, v, w = map(min, extents[1], window[1])
    return ((x, y, z), (u, v, w)) if x <= u and y <= v and z <= w else extents


def _transform(mapping: tuple[str, Matrix] | None, extents: IndexBounds | None) -> Transform | None:
    """From index space to world space, via the unit cube around the outermost voxels."""
    if mapping is None or extents is None:
        return None
    kind, matrix = mapping
    scale = [1 / (high - low + 1) for low, high in zip(*extents, strict=True)]
    offset = [(0.5 - low) * size for low, size in zip(extents[0], scale, strict=True)]
    return Transform(kind, multiply(scale_translate(scale, offset), matrix))
