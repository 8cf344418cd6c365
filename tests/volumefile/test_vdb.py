"""The OpenVDB reader against the library: its files, new ones, and what a header may hold."""

from __future__ import annotations

import json
import math
import re
import shutil
import struct
import subprocess
from pathlib import Path
from typing import Any

import pytest
import vdbwriter as w
from attempts import Reader, refusal
from process import SAMPLES

from usdvol_lint.volumefile import Grid, Metadatum, read_volume_file

EXPECTED: list[dict[str, Any]] = json.loads((SAMPLES / "expected.json").read_text("utf-8"))


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


@pytest.mark.parametrize("version", [222, 223, 224, 225])
def test_versions_that_are_read(read: Reader, version: int) -> None:
    file = read(w.vdb(w.Grid(), version=version, library=(3, 2)))
    assert (file.version, file.version_number, file.library) == (str(version), version, "3.2")
    assert file.newer is None


@pytest.mark.parametrize("version", [1, 2, 211, 221])
def test_older_versions_are_refused(read: Reader, version: int) -> None:
    error = refusal(read, w.vdb(w.Grid(), version=version))
    assert (error.code, error.offset) == ("version-unsupported", 8)
    assert error.partial is None or error.partial.version_number == version


@pytest.mark.parametrize("version", [0, 3, 210, 1000, 2**31, 2**32 - 1])
def test_versions_that_never_were_are_garbage(read: Reader, version: int) -> None:
    error = refusal(read, w.vdb(w.Grid(), version=version))
    assert (error.code, error.offset) == ("not-a-volume-file", 8)
    assert error.message == f"no OpenVDB writes file version {version}"


@pytest.mark.parametrize("version", [226, 999])
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


SYSTEM_PYTHON = "/usr/bin/python3"


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
