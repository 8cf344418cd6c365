"""The OpenVDB reader against what the library says, and against files that lie."""

from __future__ import annotations

import json
import math
import random
import re
import shutil
import struct
import subprocess
import time
import tracemalloc
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import vdbwriter as w
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from process import SAMPLES

from usdvol_lint.volumefile import Grid, Metadatum, VolumeFile, VolumeFileError, read_volume_file

EXPECTED: list[dict[str, Any]] = json.loads((SAMPLES / "expected.json").read_text("utf-8"))
SYSTEM_PYTHON = "/usr/bin/python3"

Reader = Callable[[bytes], VolumeFile]


@pytest.fixture
def read(tmp_path: Path) -> Reader:
    """Reads a file of the given bytes."""
    path = tmp_path / "file.vdb"

    def read_bytes(content: bytes) -> VolumeFile:
        path.write_bytes(content)
        return read_volume_file(str(path))

    return read_bytes


def refusal(read: Reader, content: bytes) -> VolumeFileError:
    with pytest.raises(VolumeFileError) as caught:
        read(content)
    return caught.value


def outcome(
    path: str, offset: int = 0, size: int | None = None
) -> tuple[str | None, VolumeFile | None]:
    """The error's code, if there is one, and what was understood."""
    try:
        return None, read_volume_file(path, offset, size)
    except VolumeFileError as error:
        words = str(error)
        words.encode()
        return error.code if len(words) < 1000 else words, error.partial


# What the library says of its own files.


@pytest.mark.parametrize("expected", EXPECTED, ids=lambda expected: expected["file"])
def test_samples_agree_with_the_library(expected: dict[str, Any]) -> None:
    file = read_volume_file(str(SAMPLES / expected["file"]))
    assert (file.format, file.complete) == ("openvdb", True)
    if "error" in expected:
        # The library refuses the whole file for one type that it does not know.
        assert expected["error"].endswith(f"{file.grids[0].tree_type} is not registered.")
        assert not file.grids[0].registered
        return
    assert f"{file.library}/{file.version}" == expected["version"]
    assert file.version_number == 224
    # What made the list took OpenVDB 10's answer for lower case; 10.1 on writes upper case.
    assert file.uuid is not None
    assert file.uuid.lower() == expected["uuid"].lower()
    # The list says that the streamed file has offsets; byte 20 of it says that it has none.
    assert file.streamed == (expected["file"] == "stream_1.vdb")
    assert {key: [entry.type, _printed(entry)] for key, entry in file.metadata.items()} == (
        expected["meta"]
    )
    # The library sorts grids by name, the reader keeps the order of the file.
    grids = sorted(file.grids, key=lambda grid: grid.label)
    assert [grid.label for grid in grids] == expected["names"]
    assert file.grid_count == len(expected["names"])
    for grid, said in zip(grids, expected["grids"], strict=True):
        shows_another = expected["file"] == "instances.vdb" and grid is not file.grids[0]
        _compare(grid, said, shows_another)
    assert file.newer is None


def _compare(grid: Grid, said: dict[str, Any], is_instance: bool) -> None:
    assert grid.name == grid.unique_name == said["name"]
    assert (grid.tree_type, grid.registered) == (said["type"], True)
    # The library's Python calls the value type of a mask bool.
    assert (grid.value_type if grid.value_type != "mask" else "bool") == said["value_type"]
    assert grid.half == said["half"]
    assert grid.grid_class == said["class"]
    assert grid.vector_type == said["vector_type"]
    creator = grid.metadata.get("creator")
    assert (creator.value if creator else "") == said["creator"]
    assert said["world_space"] == ("is_local_space" not in grid.metadata)
    # The reader keeps the key of the delayed-load table out, as the library does.
    assert {
        key: [entry.type, _printed(entry), entry.size] for key, entry in grid.metadata.items()
    } == said["meta"]
    transform = grid.transform
    assert transform is not None
    assert (transform.map_type, transform.linear) == (said["map"], said["map"][:3] != "Non")
    points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (-13.5, 22.25, 41)]
    for point, image in zip(points, said["pts"], strict=True):
        assert transform.apply(point) == pytest.approx(image, rel=1e-12, abs=1e-12)
    if transform.linear:  # of a frustum, the library tells a size that depends on where one asks
        origin = transform.apply((0, 0, 0))
        sizes = [math.dist(transform.apply(axis), origin) for axis in points[1:4]]
        assert sizes == pytest.approx(said["voxel_size"], rel=1e-12)
    bounds = grid.world_bounds(0.5)
    if grid.is_empty:
        # The library transforms the box from INT_MAX to INT_MIN of a grid without voxels.
        assert bounds is None
        assert said["meta"]["file_voxel_count"][1] == "0"
    elif is_instance:
        # Instances have no box of their own, and the library looks no further.
        assert "wbbox" not in said
        assert bounds is not None
    elif "wbbox" in said:
        assert bounds is not None
        for corner, wanted in zip(bounds, said["wbbox"], strict=True):
            assert corner == pytest.approx(wanted, rel=1e-12, abs=1e-12)
    else:
        assert bounds is None


def _printed(entry: Metadatum) -> str:
    """A value as the library prints it."""
    if isinstance(entry.value, bool):
        return str(entry.value).lower()
    return str(list(entry.value)) if isinstance(entry.value, tuple) else str(entry.value)


def test_grids_keep_file_order() -> None:
    file = read_volume_file(str(SAMPLES / "dup_names.vdb"))
    assert [grid.label for grid in file.grids] == [
        *("density[0]", "density[1]", "density[2]", "a_temp", "density[3]"),
    ]


def test_instances_show_the_voxels_of_their_parent() -> None:
    a, b, c = read_volume_file(str(SAMPLES / "instances.vdb")).grids
    assert a.index_bounds == b.index_bounds == c.index_bounds == ((-4, 2, 0), (7, 4, 24))
    assert b.world_bounds() == ((-1, 0.5, 0), (1.75, 1, 6))


# What a header may hold.


@pytest.mark.parametrize("version", [222, 223, 224, 225])
def test_versions_that_are_read(read: Reader, version: int) -> None:
    file = read(w.vdb(w.Grid(), version=version, library=(3, 2)))
    assert (file.version, file.version_number, file.library) == (str(version), version, "3.2")
    assert file.newer is None


@pytest.mark.parametrize("version", [0, 1, 211, 221])
def test_older_versions_are_refused(read: Reader, version: int) -> None:
    error = refusal(read, w.vdb(w.Grid(), version=version))
    assert (error.code, error.offset) == ("version-unsupported", 8)
    assert error.partial is None or error.partial.version_number == version


@pytest.mark.parametrize("version", [226, 2**31, 2**32 - 1])
def test_newer_versions_are_tried(read: Reader, version: int) -> None:
    file = read(w.vdb(w.Grid(), version=version))
    assert file.newer == f"file version {version} is newer than 225"
    assert [grid.name for grid in file.grids] == ["density"]
    for broken in (w.Grid(transform=w.text("HelixMap")), w.Grid(voxels=b"", offsets=_far_end)):
        error = refusal(read, w.vdb(broken, version=version))
        assert error.code == "version-unsupported"
        assert error.partial is not None
        assert error.message.startswith(f"{file.newer}: ")
        assert error.partial.newer == file.newer


def _far_end(start: int, blocks: int, end: int) -> tuple[int, int, int]:
    return start, blocks, end + 1


def test_uuid_may_be_blank(read: Reader) -> None:
    assert read(w.vdb(uuid=b"\0" + w.UUID[1:])).uuid is None
    assert read(w.vdb()).uuid == w.UUID.decode()


def test_metadata_of_every_type(read: Reader) -> None:
    entries = {
        "b": w.value("bool", True),
        "i": w.value("int32", -5),
        "l": w.value("int64", -(2**40)),
        "f": w.value("float", 0.5),
        "d": w.value("double", 0.1),
        "v2i": w.value("vec2i", 1, 2),
        "v3s": w.value("vec3s", 1, 2, 3),
        "v4d": w.value("vec4d", 1, 2, 3, 4),
        "m": ("mat4d", struct.pack("<16d", *range(16))),
        "s": w.string("größe"),
        "empty": w.string(""),
        "latin": w.string(b"gr\xf6\xdfe"),
        "custom": ("studio_type", b"\1\2\3"),
        "gone": ("__temporary", b"\1\2\3"),
        "long": w.string(b"x" * ((1 << 20) + 1)),
    }
    file = read(w.vdb(metadata_bytes=w.metadata(entries)))
    assert {name: (entry.type, entry.value) for name, entry in file.metadata.items()} == {
        "b": ("bool", True),
        "i": ("int32", -5),
        "l": ("int64", -(2**40)),
        "f": ("float", 0.5),
        "d": ("double", 0.1),
        "v2i": ("vec2i", (1, 2)),
        "v3s": ("vec3s", (1, 2, 3)),
        "v4d": ("vec4d", (1, 2, 3, 4)),
        "m": ("mat4d", tuple(range(16))),
        "s": ("string", "größe"),
        "empty": ("string", ""),
        "latin": ("string", "gr\udcf6\udcdfe"),
        "custom": ("studio_type", None),
        "long": ("string", None),
    }
    assert file.metadata["custom"].size == 3


# What a grid may say.


@pytest.mark.parametrize(
    ("said", "understood"),
    [
        (w.string("level set"), "level set"),
        (w.string("  Fog Volume\n"), "fog volume"),
        (w.string("STAGGERED"), "staggered"),
        (w.string("unknown"), "unknown"),
        (w.string("fogVolume"), "unknown"),
        (w.value("int32", 1), "unknown"),
    ],
)
def test_classes(read: Reader, said: tuple[str, bytes], understood: str) -> None:
    entries = {"name": w.string("density"), "class": said}
    assert read(w.vdb(w.Grid(metadata=entries))).grids[0].grid_class == understood


@pytest.mark.parametrize(
    ("said", "understood"),
    [
        ("invariant", "invariant"),
        ("covariant", "covariant"),
        ("covariant normalize", "covariant normalize"),
        ("Contravariant Relative ", "contravariant relative"),
        ("contravariant absolute", "contravariant absolute"),
        ("odd", "invariant"),
    ],
)
def test_vector_types(read: Reader, said: str, understood: str) -> None:
    entries = {"name": w.string("v"), "vector_type": w.string(said)}
    grid = read(w.vdb(w.Grid("v", "Tree_vec3s_5_4_3", metadata=entries))).grids[0]
    assert (grid.value_type, grid.vector_type) == ("vec3s", understood)


@pytest.mark.parametrize(
    ("stored", "value_type", "registered"),
    [
        ("Tree_float_5_4_3", "float", True),
        ("Tree_half_5_4_3", "half", True),
        ("Tree_ptdataidx32_5_4_3", "ptdataidx32", True),
        ("Tree_float_4_3_2", "float", False),
        ("Tree_string_5_4_3", "string", False),
        ("Tree_quat_of_mine_5_4_3", "quat_of_mine", False),
        ("Tree_5_4_3", "5", False),
        ("Tree", "Tree", False),
        ("", "", False),
    ],
)
def test_grid_types(read: Reader, stored: str, value_type: str, registered: bool) -> None:
    file = read(w.vdb(w.Grid(type=stored)))
    (grid,) = file.grids
    assert (grid.value_type, grid.tree_type) == (value_type, stored)
    assert grid.registered == registered


@pytest.mark.parametrize("suffix", ["", "_HalfFloat"])
@pytest.mark.parametrize("flag", [None, False, True])
def test_half(read: Reader, suffix: str, flag: bool | None) -> None:
    entries = {"name": w.string("density")}
    if flag is not None:
        entries["is_saved_as_half_float"] = w.value("bool", flag)
    file = read(w.vdb(w.Grid(type=f"Tree_int32_5_4_3{suffix}", metadata=entries)))
    assert file.grids[0].half == (bool(suffix) or flag is True)
    assert file.grids[0].tree_type == "Tree_int32_5_4_3"


def test_bounds(read: Reader) -> None:
    def grid(low: tuple[int, int, int], high: tuple[int, int, int]) -> Grid:
        entries = {"name": w.string("density"), **w.bounds(low, high)}
        return read(w.vdb(w.Grid(metadata=entries, transform=w.scale(2, 2, 2)))).grids[0]

    usual = grid((-1, 0, 1), (1, 0, 2))
    assert (usual.index_bounds, usual.is_empty) == (((-1, 0, 1), (1, 0, 2)), False)
    assert usual.world_bounds() == ((-2, 0, 2), (2, 0, 4))
    assert usual.world_bounds(0.5) == ((-3, -1, 1), (3, 1, 5))
    empty = grid((2**31 - 1,) * 3, (-(2**31),) * 3)
    assert (empty.index_bounds, empty.is_empty, empty.world_bounds()) == (None, True, None)
    half_given = {"name": w.string("density"), "file_bbox_min": w.value("vec3i", 0, 0, 0)}
    (unknown,) = read(w.vdb(w.Grid(metadata=half_given))).grids
    assert (unknown.index_bounds, unknown.is_empty) == (None, False)
    mistyped = {"file_bbox_min": w.value("vec3d", 0, 0, 0), "file_bbox_max": w.string("big")}
    (unknown,) = read(w.vdb(w.Grid(metadata=mistyped))).grids
    assert unknown.index_bounds is None


def test_bounds_that_overflow_are_unknown(read: Reader) -> None:
    entries = {"name": w.string("density"), **w.bounds((-9, 0, 0), (9, 1, 1))}
    grid = w.Grid(metadata=entries, transform=w.scale(1e308, 1, 1))
    assert read(w.vdb(grid)).grids[0].world_bounds() is None


@pytest.mark.parametrize(
    ("stored", "kind", "image"),
    [
        (w.affine(*range(16)), "AffineMap", (44, 51, 58)),
        (w.affine(*range(16), kind="UnitaryMap"), "UnitaryMap", (44, 51, 58)),
        (w.scale(2, 3, 4), "ScaleMap", (2, 6, 12)),
        (w.scale(2, 2, 2, "UniformScaleMap"), "UniformScaleMap", (2, 4, 6)),
        (w.scale_translate((2, 3, 4), (10, 20, 30)), "ScaleTranslateMap", (12, 26, 42)),
        (
            w.scale_translate((2, 2, 2), (10, 20, 30), "UniformScaleTranslateMap"),
            "UniformScaleTranslateMap",
            (12, 24, 36),
        ),
        (w.translation(10, 20, 30), "TranslationMap", (11, 22, 33)),
        (w.scale(0, 1, 1), "ScaleMap", (0, 2, 3)),
    ],
)
def test_linear_maps(
    read: Reader, stored: bytes, kind: str, image: tuple[float, float, float]
) -> None:
    transform = read(w.vdb(w.Grid(transform=stored))).grids[0].transform
    assert transform is not None
    assert (transform.map_type, transform.linear, transform.frustum) == (kind, True, None)
    assert transform.apply((1, 2, 3)) == image


@pytest.mark.parametrize("taper", [0.25, 1, 3])
@pytest.mark.parametrize(
    "second", [w.scale(2, 3, 4), w.affine(1, 2, 0, 0, 0, 1, 3, 0, 4, 0, 1, 0, 5, 6, 7, 1)]
)
def test_frustum_bounds_are_exact(read: Reader, taper: float, second: bytes) -> None:
    map_ = w.frustum((0, 0, 0), (20, 30, 40), taper, 2.5, second)
    entries = {"name": w.string("density"), **w.bounds((2, 3, 4), (17, 29, 31))}
    grid = read(w.vdb(w.Grid(metadata=entries, transform=map_))).grids[0]
    assert grid.transform is not None
    assert (grid.transform.map_type, grid.transform.linear) == ("NonlinearFrustumMap", False)
    low, high = grid.world_bounds() or pytest.fail("no bounds")
    dice = random.Random(taper)
    points = [
        grid.transform.apply((dice.uniform(2, 17), dice.uniform(3, 29), dice.uniform(4, 31)))
        for _ in range(2000)
    ]
    for axis in range(3):
        values = [point[axis] for point in points]
        room = high[axis] - low[axis]
        assert low[axis] <= min(values) <= low[axis] + room / 4
        assert high[axis] - room / 4 <= max(values) <= high[axis]


def test_names_with_suffixes(read: Reader) -> None:
    names = ["density\x1e0", "density\x1e1", "\x1e0", "a\x1eb\x1ec", "density"]
    file = read(w.vdb(*(w.Grid(name) for name in names)))
    assert [(grid.unique_name, grid.suffix, grid.label) for grid in file.grids] == [
        ("density", "0", "density[0]"),
        ("density", "1", "density[1]"),
        ("", "0", "[0]"),
        ("a", "b\x1ec", "a[b\x1ec]"),
        ("density", None, "density"),
    ]


@pytest.mark.parametrize("name", ["a/b c.d", "density[0]", "größe", " ", "a\0b", "密度"])
def test_names_are_taken_as_they_are(read: Reader, name: str) -> None:
    assert read(w.vdb(w.Grid(name))).grids[0].unique_name == name


def test_names_that_are_no_unicode_survive(read: Reader) -> None:
    (grid,) = read(w.vdb(w.Grid(b"gr\xf6\xdfe"))).grids
    assert grid.name.encode("utf-8", "surrogateescape") == b"gr\xf6\xdfe"


def test_unnamed_grid_without_metadata(read: Reader) -> None:
    """Older Houdini wrote such: an empty name with a suffix, and no metadata."""
    file = read(w.vdb(w.Grid("\x1e0", metadata={})))
    assert (file.grids[0].name, file.grids[0].unique_name) == ("", "")


def test_names_that_differ(read: Reader) -> None:
    file = read(w.vdb(w.Grid("smoke"), w.Grid("density", metadata={"name": w.string("d" * 200)})))
    assert [grid.name for grid in file.grids] == ["smoke", "d" * 200]
    assert [grid.unique_name for grid in file.grids] == ["smoke", "density"]


def test_names_that_are_repeated(read: Reader) -> None:
    file = read(w.vdb(w.Grid(), w.Grid()))
    assert [(grid.name, grid.label) for grid in file.grids] == [("density", "density")] * 2


def test_instances(read: Reader) -> None:
    box = {"name": w.string("a"), **w.bounds((0, 0, 0), (1, 2, 3))}
    empty = {"name": w.string("e"), **w.bounds((2**31 - 1,) * 3, (-(2**31),) * 3)}
    file = read(
        w.vdb(
            w.Grid("a", metadata=box),
            w.Grid("b", parent="a", transform=w.scale(2, 2, 2)),
            w.Grid("e", metadata=empty),
            w.Grid("f", parent="e"),
            w.Grid("g", parent="nobody"),
            w.Grid("h", parent="h"),
        )
    )
    _, b, _, f, g, h = file.grids
    assert b.world_bounds() == ((0, 0, 0), (2, 4, 6))
    assert (f.is_empty, f.index_bounds) == (True, None)
    assert (g.index_bounds, h.index_bounds) == (None, None)


def test_streamed_files_show_their_first_grid(read: Reader) -> None:
    file = read(w.vdb(w.Grid("a"), w.Grid("b"), seekable=False))
    assert [grid.name for grid in file.grids] == ["a"]
    assert (file.streamed, file.complete, file.grid_count) == (True, False, 2)
    assert read(w.vdb(w.Grid("a"), seekable=False)).complete
    assert read(w.vdb(seekable=False)).grids == ()


def test_bytes_after_the_last_grid_are_ignored(read: Reader) -> None:
    assert read(w.vdb(w.Grid()) + b"more").complete


# Files that lie.

NAN, INF = float("nan"), float("inf")
UNIT = (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)


def _lie(start: int, blocks: int, end: int) -> Callable[[int, int, int], tuple[int, int, int]]:
    return lambda *_: (start, blocks, end)


LIES: dict[str, tuple[bytes, str]] = {
    "grids-2^31": (w.vdb(w.Grid(), count=2**31), "not-a-volume-file"),
    "grids-2^31-1": (w.vdb(w.Grid(), count=2**31 - 1), "not-a-volume-file"),
    "grids-100000": (w.vdb(w.Grid(), count=100_000), "truncated"),
    "grids-one-more": (w.vdb(w.Grid(), count=2), "truncated"),
    "name-4-gib": (
        w.vdb(w.Grid(b"")).replace(b"\x00\x00\x00\x00\x10", b"\xff" * 4 + b"\x10"),
        "not-a-volume-file",
    ),
    "entries-4-g": (w.vdb(metadata_bytes=b"\xff\xff\xff\xff"), "not-a-volume-file"),
    "entries-1000": (w.vdb(metadata_bytes=w.metadata({}, count=1000)), "truncated"),
    "entry-unnamed": (w.vdb(metadata_bytes=w.metadata({"": w.string("x")})), "not-a-volume-file"),
    "entry-key-long": (
        w.vdb(metadata_bytes=w.metadata({}, w.text(b"", 2**32 - 1) + bytes(9), 1)),
        "not-a-volume-file",
    ),
    "value-4-gib": (
        w.vdb(metadata_bytes=w.metadata({}, w.metadatum("a", "string", b"", 2**32 - 1), 1)),
        "truncated",
    ),
    "value-4-gib-opaque": (
        w.vdb(metadata_bytes=w.metadata({}, w.metadatum("a", "blob", b"", 2**32 - 1), 1)),
        "truncated",
    ),
    "value-size": (
        w.vdb(metadata_bytes=w.metadata({}, w.metadatum("a", "int32", bytes(8)), 1)),
        "not-a-volume-file",
    ),
    "value-out-of-section": (
        w.vdb(
            w.Grid(raw_metadata=w.metadata({}, w.metadatum("a", "x", b"", 2000), 1)),
            w.Grid(voxels=bytes(4000)),
        ),
        "not-a-volume-file",
    ),
    "offsets-zero": (w.vdb(w.Grid(offsets=_lie(0, 0, 0))), "not-a-volume-file"),
    "offsets-backward": (w.vdb(w.Grid(offsets=lambda a, b, c: (a, c, b))), "not-a-volume-file"),
    "offsets-loop": (w.vdb(w.Grid(offsets=_lie(65, 65, 65)), count=1), "not-a-volume-file"),
    "offsets-negative": (w.vdb(w.Grid(offsets=_lie(-1, -1, -1))), "not-a-volume-file"),
    "offsets-2^63-1": (w.vdb(w.Grid(offsets=_lie(*(2**63 - 1,) * 3))), "truncated"),
    "blocks-before-transform": (
        w.vdb(w.Grid(offsets=lambda a, b, c: (a, a + 40, c))),
        "not-a-volume-file",
    ),
    "end-one-more": (w.vdb(w.Grid(offsets=lambda a, b, c: (a, b, c + 1))), "truncated"),
    "instance-end": (
        w.vdb(w.Grid("a"), w.Grid("b", parent="a", offsets=lambda a, b, c: (a, b, c - 1))),
        "not-a-volume-file",
    ),
    "map-unknown": (w.vdb(w.Grid(transform=w.text("HelixMap"))), "not-a-volume-file"),
    "map-nameless": (w.vdb(w.Grid(transform=w.text(""))), "not-a-volume-file"),
    "map-name-long": (w.vdb(w.Grid(transform=w.text("x" * 300))), "not-a-volume-file"),
    "type-long": (w.vdb(w.Grid(type="x" * 1025)), "not-a-volume-file"),
    "name-long": (w.vdb(w.Grid("x" * 65537)), "not-a-volume-file"),
    "nan-affine": (w.vdb(w.Grid(transform=w.affine(NAN, *UNIT[1:]))), "not-a-volume-file"),
    "nan-last-column": (w.vdb(w.Grid(transform=w.affine(*UNIT[:-1], NAN))), "not-a-volume-file"),
    "inf-scale": (w.vdb(w.Grid(transform=w.scale(INF, 1, 1))), "not-a-volume-file"),
    "nan-translation": (w.vdb(w.Grid(transform=w.translation(0, 0, NAN))), "not-a-volume-file"),
    "nan-scale-translate": (
        w.vdb(w.Grid(transform=w.scale_translate((1, 1, 1), (0, INF, 0)))),
        "not-a-volume-file",
    ),
    "frustum-in-frustum": (
        w.vdb(
            w.Grid(
                transform=w.frustum(
                    (0, 0, 0), (1, 1, 1), 1, 1, w.frustum((0, 0, 0), (1, 1, 1), 1, 1)
                )
            )
        ),
        "not-a-volume-file",
    ),
    "frustum-flat": (
        w.vdb(w.Grid(transform=w.frustum((0, 0, 0), (1, 0, 1), 1, 1))),
        "not-a-volume-file",
    ),
    "frustum-taper": (
        w.vdb(w.Grid(transform=w.frustum((0, 0, 0), (1, 1, 1), 0, 1))),
        "not-a-volume-file",
    ),
    "frustum-depth": (
        w.vdb(w.Grid(transform=w.frustum((0, 0, 0), (1, 1, 1), 1, NAN))),
        "not-a-volume-file",
    ),
    "frustum-nan-map": (
        w.vdb(w.Grid(transform=w.frustum((0, 0, 0), (1, 1, 1), 1, 1, w.scale(NAN, 1, 1)))),
        "not-a-volume-file",
    ),
}


@pytest.mark.parametrize(("content", "code"), LIES.values(), ids=LIES)
def test_lies_are_told(read: Reader, content: bytes, code: str) -> None:
    tracemalloc.start()
    try:
        start = time.perf_counter()
        error = refusal(read, content)
        assert time.perf_counter() - start < 1
        assert tracemalloc.get_traced_memory()[1] < 2 << 20
    finally:
        tracemalloc.stop()
    assert error.code == code
    assert error.offset is not None
    assert error.offset >= 0
    assert len(str(error)) < 300
    assert error.partial is not None
    assert (error.partial.version, error.partial.library) == ("224", "10.0")


def test_an_error_says_where_and_what_came_before(read: Reader) -> None:
    good, bad = w.Grid("good"), w.Grid("bad", transform=w.text("HelixMap"))
    content = w.vdb(good, bad)
    error = refusal(read, content)
    assert error.message == "unknown transform 'HelixMap'"
    assert error.offset == content.index(b"HelixMap") - 4
    assert str(error) == f"unknown transform 'HelixMap' (at byte {error.offset})"
    assert error.partial is not None
    assert [grid.name for grid in error.partial.grids] == ["good"]
    assert (error.partial.complete, error.partial.grid_count) == (False, 2)


def test_promised_grids_need_room(read: Reader) -> None:
    """No work is done for a number that the file can't hold."""
    error = refusal(read, w.vdb(w.Grid(), count=100_000))
    assert (error.code, error.offset) == ("truncated", 65)
    assert error.partial is not None
    assert (error.partial.grids, error.partial.complete) == ((), False)


def test_truncated_voxels_leave_the_grid_readable(read: Reader) -> None:
    content = w.vdb(w.Grid("a"), w.Grid("b"))
    error = refusal(read, content[:-1])
    assert (error.code, error.offset) == ("truncated", len(content) - 1)
    assert str(len(content)) in error.message
    assert error.partial is not None
    assert [grid.name for grid in error.partial.grids] == ["a", "b"]
    assert not error.partial.complete


def test_many_entries_take_memory_in_proportion(read: Reader) -> None:
    one = w.metadatum("same", "bool", b"\1")
    content = w.vdb(metadata_bytes=w.metadata({}, one * 20_000, 20_000))
    tracemalloc.start()
    try:
        assert read(content).metadata == {"same": Metadatum("bool", True, 1)}
        assert tracemalloc.get_traced_memory()[1] < len(content) + (8 << 20)
    finally:
        tracemalloc.stop()


# Cuts.

WHOLE = sorted(SAMPLES.glob("*.vdb"))


@pytest.mark.parametrize("path", WHOLE, ids=lambda path: path.name)
def test_every_cut_is_noticed(path: Path) -> None:
    whole = read_volume_file(str(path))
    size = path.stat().st_size
    last = path.read_bytes().rfind(b"Tree_")
    cuts = {1, 4, 7, 8, 12, 20, 21, 30, 57, 60, 64, 65, 90, 130, 200, 300, size - 1, size // 2}
    cuts |= set(range(0, min(size, 900), 3)) | set(range(97, size, 97))
    cuts |= {last + step for step in range(0, 700, 11)}
    for cut in sorted(cut for cut in cuts if 0 <= cut < size):
        code, file = outcome(str(path), 0, cut)
        if code is None:
            assert whole.streamed, cut  # nothing else can do without its end
        else:
            assert code == ("truncated" if cut else "not-a-file"), cut
        before = [grid.label for grid in file.grids] if file else []
        assert before == [grid.label for grid in whole.grids[: len(before)]]


@pytest.mark.parametrize("cut", [4, 8, 12, 30, 60, 400, 10_000])
def test_cut_files_are_noticed_as_cut_views_are(tmp_path: Path, cut: int) -> None:
    whole = (SAMPLES / "class_0.vdb").read_bytes()
    (tmp_path / "cut.vdb").write_bytes(whole[:cut])
    with pytest.raises(VolumeFileError) as caught:
        read_volume_file(str(tmp_path / "cut.vdb"))
    assert caught.value.code == "truncated"


# Mutations.


def _everything() -> bytes:
    """A file with every trait, small enough to change anywhere."""
    return w.vdb(
        w.Grid(
            "density\x1e0",
            metadata={
                "name": w.string("density"),
                "class": w.string("fog volume"),
                **w.bounds((0, 0, 0), (9, 9, 9)),
            },
        ),
        w.Grid("density\x1e1", "Tree_vec3s_5_4_3_HalfFloat", transform=w.affine(*UNIT)),
        w.Grid("i", parent="density\x1e0", transform=w.scale_translate((1, 2, 3), (4, 5, 6))),
        w.Grid(
            "f",
            transform=w.frustum((0, 0, 0), (9, 9, 9), 0.5, 2),
            metadata={"name": w.string("f"), **w.bounds((0, 0, 0), (9, 9, 9))},
        ),
        metadata_bytes=w.metadata({"creator": w.string("Houdini"), "v": w.value("vec3d", 1, 2, 3)}),
    )


SEEDS = [
    _everything(),
    w.vdb(w.Grid("s"), w.Grid("t"), seekable=False),
    *((SAMPLES / name).read_bytes() for name in ("lib12_float_half.vdb", "empty_grid.vdb")),
]
WORDS = [
    *(struct.pack("<i", n) for n in (0, 1, -1, 2**31 - 1, -(2**31), 65536, 100_000, 1 << 20)),
    *(struct.pack("<q", n) for n in (0, 1, -1, 2**63 - 1, -(2**63), 65, 500)),
    *(struct.pack("<d", n) for n in (0.0, NAN, INF, 1e308, 5e-324)),
    *(b"\0", b"\xff", b"\x80", b"\x1e", w.text("NonlinearFrustumMap"), w.text("__x")),
]
CODES = {"not-a-volume-file", "truncated", "version-unsupported", "not-a-file"}


@st.composite
def mutants(draw: st.DrawFn) -> bytes:
    content = bytearray(draw(st.sampled_from(SEEDS)))
    for _ in range(draw(st.integers(1, 4))):
        at = draw(st.integers(0, min(len(content), 1500)))
        word = draw(st.sampled_from(WORDS) | st.binary(min_size=1, max_size=8))
        match draw(st.integers(0, 3)):
            case 0 | 1:
                content[at : at + len(word)] = word
            case 2:
                content[at:at] = word
            case _:
                del content[at : at + draw(st.integers(1, 40))]
    return bytes(content)


def survives(path: Path, offset: int = 0, size: int | None = None) -> None:
    """Reading gives a file whose parts can be used, or the one kind of error."""
    start = time.perf_counter()
    code, file = outcome(str(path), offset, size)
    assert code is None or code in CODES
    if file is not None:
        assert file.complete == (code is None and len(file.grids) == file.grid_count)
    for grid in file.grids if file else ():
        grid.world_bounds(0.5)
    assert time.perf_counter() - start < 1


@settings(
    max_examples=2000,
    derandomize=True,
    deadline=None,
    database=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
@given(content=mutants())
def test_mutants_raise_nothing_else(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "mutant.vdb"
    path.write_bytes(content)
    survives(path)


@settings(
    max_examples=200,
    derandomize=True,
    deadline=None,
    database=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
@given(content=mutants())
def test_mutants_take_little_memory(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "mutant.vdb"
    path.write_bytes(content)
    tracemalloc.start()
    try:
        survives(path)
        assert tracemalloc.get_traced_memory()[1] < len(content) + (8 << 20)
    finally:
        tracemalloc.stop()


def test_every_byte_of_a_head_may_be_anything(tmp_path: Path) -> None:
    """Each byte on its own, at its extremes: what generated mutants may miss."""
    whole, path = _everything(), tmp_path / "bytes"
    for byte in (b"\0", b"\x7f", b"\xff"):
        path.write_bytes(b"".join(whole[:at] + byte + whole[at + 1 :] for at in range(len(whole))))
        for at in range(len(whole)):
            survives(path, at * len(whole), len(whole))


# The library itself, where it is installed.


def _needs_library() -> None:
    if shutil.which("vdb_print") is None:
        pytest.skip("no vdb_print, which libopenvdb-tools installs")
    probe = [SYSTEM_PYTHON, "-c", "import pyopenvdb"]
    if not Path(SYSTEM_PYTHON).exists() or subprocess.run(probe, capture_output=True).returncode:
        pytest.skip("no pyopenvdb, which python3-openvdb installs")


GENERATOR = """
import pyopenvdb as vdb, random, sys
dice = random.Random(4)
for number in range(12):
    grids = []
    for _ in range(dice.randint(1, 4)):
        kind = dice.choice([vdb.FloatGrid, vdb.BoolGrid, vdb.Vec3SGrid])
        grid = kind()
        for _ in range(dice.choice([0, 1, 5])):
            at = [dice.randint(-300, 300) for _ in range(3)]
            value = (1, 2, 3) if kind is vdb.Vec3SGrid else 1
            grid.fill(at, [a + dice.randint(0, 9) for a in at], value)
        grid.name = dice.choice(["density", "vel", "a b", ""])
        grid.gridClass = dice.choice(["level set", "fog volume", "staggered", "unknown"])
        grid.saveFloatAsHalf = dice.random() < 0.5
        grid.transform = vdb.createLinearTransform(dice.choice([0.1, 1.0, 3.0]))
        grid.transform.rotate(dice.choice([0, 0.5]), vdb.Axis.Y)
        grid.transform.translate([dice.choice([0, 7.5]), 0, -2])
        grid["shot"] = "sq%02d" % number
        grids.append(grid)
    vdb.write(f"{sys.argv[1]}/{number:02}.vdb", grids, {"frame": number})
"""


def test_files_that_the_library_writes_now(tmp_path: Path) -> None:
    _needs_library()
    subprocess.run([SYSTEM_PYTHON, "-c", GENERATOR, str(tmp_path)], check=True)
    paths = sorted(tmp_path.glob("*.vdb"))
    assert len(paths) == 12
    for path in paths:
        printed = subprocess.run(
            ["vdb_print", "-l", str(path)], check=True, capture_output=True, text=True
        ).stdout
        file = read_volume_file(str(path))
        assert f"VDB version: {file.library}/{file.version}" in printed
        assert f"frame: {int(path.stem)}" in printed
        reports = printed.split("Name:")[1:]
        # vdb_print sorts grids by name, and keeps the order of the file among namesakes.
        grids = sorted(file.grids, key=lambda grid: grid.unique_name)
        assert len(grids) == len(reports)
        for grid, report in zip(grids, reports, strict=True):
            _compare_report(grid, report)


def _compare_report(grid: Grid, report: str) -> None:
    assert report.splitlines()[0].strip() == grid.name.strip()
    assert f"Type: {grid.tree_type}\n" in report
    for key in ("class", "name", "shot", "is_saved_as_half_float"):
        shown = re.search(rf"^  {key}(?:: (.*))?$", report, re.MULTILINE)
        entry = grid.metadata.get(key)
        assert (shown is None) == (entry is None), key
        if shown is not None and entry is not None:
            assert (shown[1] or "") == _printed(entry), key
    box = re.search(r"Bounding box of active voxels: (\[.*\]) -> (\[.*\])", report)
    if grid.is_empty:
        assert box is None or box[1] == str([2**31 - 1] * 3)
    else:
        assert box is not None
        assert grid.index_bounds is not None
        assert [box[1], box[2]] == [str(list(corner)) for corner in grid.index_bounds]
    assert grid.transform is not None
    matrix = [
        [float(number) for number in row.split(",")]
        for row in re.findall(r"^ +\[(.*, .*, .*, .*)\] *$", report, re.MULTILINE)
    ]
    assert len(matrix) == 4
    for row, printed in zip(grid.transform.matrix, matrix, strict=True):
        assert row == pytest.approx(printed, rel=5e-3, abs=1e-6)  # three digits are printed
