"""The volume files that scenes name, with what is in them: known from their writers, not read.

Those of `tests/samples` are described by OpenVDB itself, in its `expected.json`.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

ROOT = Path(__file__).parents[2]
SHARED = "assets"
"""The folder of the shared files, beside those of the scenes."""

Point: TypeAlias = tuple[float, float, float]


class Grid(NamedTuple):
    """A grid, with the tokens that a field may author for it; `low` and `high` enclose it."""

    name: str
    data_types: tuple[str, ...]
    field_class: str
    low: Point
    high: Point
    roles: tuple[str, ...] = ()
    field_index: int | None = None
    purpose: str | None = None


class Source(NamedTuple):
    """A file, from the folder of a scene, and the grids in it that a field can name."""

    path: str
    grids: tuple[Grid, ...]
    prim_type: str = "OpenVDBAsset"


def shared(path: str) -> str:
    """The path of a shared file, from the folder of a scene."""
    return f"../{SHARED}/{path}"


def original(path: str) -> Path:
    """The file that a shared one is a copy of."""
    path = path.removeprefix(f"../{SHARED}/")
    return ROOT / ("tests" if path.startswith("samples/") else "rules/assets") / path


_PUFF = ((0.15, 0.15, 0.15), (0.65, 0.65, 0.65))
_BOX = ((0.05, 0.05, 0.05), (0.85, 0.85, 0.85))
_FLOAT = ("float", "fogVolume")
_ROLES = ("Vector", "Color", "Normal", "None")


def _density(
    path: str,
    *,
    data_types: tuple[str, ...] = ("float",),
    kind: str = "fogVolume",
    corners: tuple[Point, Point] = _BOX,
    field_index: int | None = None,
) -> Source:
    grid = Grid("density", data_types, kind, *corners, field_index=field_index)
    return Source(shared(path), (grid,))


def _cloud() -> Source:
    names = ("density", "temperature")
    grids = (Grid(name, ("float",), "fogVolume", *_PUFF) for name in names)
    return Source(shared("cloud.vdb"), tuple(grids))


def _velocity(path: str, kind: str, roles: tuple[str, ...]) -> Source:
    return Source(shared(path), (Grid("velocity", ("float3",), kind, *_BOX, roles),))


def _split_velocity() -> Source:
    grids = (Grid(f"vel.{axis}", ("float",), "fogVolume", *_BOX) for axis in "xyz")
    return Source(shared("grids/split_velocity.vdb"), tuple(grids))


def _field3d(name: str) -> Source:
    corners = ((0.33, 0.37, 0.33), (1.34, 2.63, 2.34))
    kinds = {"temperature": "half", "heat": "double"}
    grids = (Grid(kind, (kinds[kind],), "unknown", *corners) for kind in kinds)
    return Source(shared(f"samples/{name}"), tuple(grids), "Field3DAsset")


def _sample_data_types(grid: dict[str, Any]) -> tuple[str, ...]:
    wanted = {"vec3s": "float3", "vec3d": "double3", "vec3i": "int3"}
    is_mask = grid["type"].startswith("Tree_mask")  # which OpenVDB's Python calls bool
    data_type = "mask" if is_mask else wanted.get(grid["value_type"], grid["value_type"])
    half = {"float": "half", "float3": "half3"}
    return (data_type, half[data_type]) if grid["half"] else (data_type,)


def _sample(described: dict[str, Any]) -> Source:
    tokens = {"level set": "levelSet", "fog volume": "fogVolume", "staggered": "staggered"}
    grids = []
    for grid in described["grids"]:
        is_vector = grid["value_type"] == "vec3s"
        is_plain = grid["vector_type"] == "invariant"
        grids.append(
            Grid(
                grid["name"],
                _sample_data_types(grid),
                tokens.get(grid["class"], "unknown"),
                tuple(grid["wbbox"][0]),
                tuple(grid["wbbox"][1]),
                (_ROLES if is_plain else ("Vector",)) if is_vector else (),
            )
        )
    return Source(shared(f"samples/{described['file']}"), tuple(grids))


def _samples() -> list[Source]:
    """Those that are sound, and whose grids have names and types that a field can author."""
    sound = (
        *("class_0", "class_1", "class_2", "half_f", "half_v3s", "lib12_float_half"),
        *("single_voxel", "type_b", "type_d", "type_f", "type_mask", "type_v3s", "vectype_0"),
        *("vectype_3", "xf_affine", "xf_scaletranslate"),
    )
    described = json.loads((ROOT / "tests/samples/expected.json").read_text(encoding="utf-8"))
    by_name = {each["file"].removesuffix(".vdb"): each for each in described}
    return [_sample(by_name[name]) for name in sound]


SOURCES = (
    _cloud(),
    _density("grids/level_set.vdb", kind="levelSet"),
    _density("grids/half.vdb", data_types=("float", "half")),
    _density("grids/double.vdb", data_types=("double",)),
    _density("grids/unclassed.vdb", kind="unknown"),
    _density("grids/no_voxels.vdb"),
    _density("grids/same_name.vdb", field_index=0),
    _density("grids/turned.vdb", corners=((0.2, 0.2, 0.1), (0.8, 0.82, 0.55))),
    _velocity("grids/velocity.vdb", "staggered", ("Vector",)),
    _velocity("grids/untyped_velocity.vdb", "unknown", _ROLES),
    _split_velocity(),
    *_samples(),
)
"""Files that an OpenVDBAsset can name."""

FIELD3D = (_field3d("f3d_ogawa.f3d"),)

FRAMES = (
    [_density(f"puff/puff.{number:04}.vdb", corners=_PUFF) for number in range(1, 8)],
    [_density(f"smoke/smoke.{number:04}.vdb", corners=_PUFF) for number in range(1, 4)],
    [_density(f"box_growing.{number:04}.vdb", corners=_BOX) for number in range(1, 4)],
)
"""Files that are one sequence each, numbered from 1."""

FRAME = _density("grids/half.vdb", data_types=("float", "half"))
"""A file to copy under the names of longer sequences."""
