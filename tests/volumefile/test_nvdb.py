"""The NanoVDB reader against files of the library's own, and against files that lie."""

from __future__ import annotations

import math
import re
import shutil
import struct
import subprocess
import zlib
from collections.abc import Callable
from pathlib import Path

import pytest
from attempts import Reader, memory_below, refusal, refusal_of_file, with_each_byte_changed
from nvdbwriter import SAMPLE, VERSION, bare, buffers, entry, segment, turned
from process import SAMPLES

from usdvol_lint.volumefile import VolumeFileError, read_volume_file

BOX = ((-4, 2, 0), (7, 4, 24))


def test_sample() -> None:
    """What nanovdb_print says of it."""
    file = read_volume_file(str(SAMPLE))
    assert (file.format, file.version, file.version_number) == ("nanovdb", "32.4.2", VERSION)
    assert (file.grid_count, file.complete, file.newer) == (6, True, None)
    assert [(grid.name, grid.value_type, grid.index_bounds) for grid in file.grids] == [
        ("b", "bool", BOX),
        ("d", "double", BOX),
        ("f", "float", BOX),
        ("i32", "int32", BOX),
        ("i64", "int64", BOX),
        ("mask", "mask", ((-7, 2, 3), (1, 9, 13))),
    ]
    for grid in file.grids:
        assert grid.transform is not None
        assert grid.transform.apply((1, 2, 3)) == (1, 2, 3)
        assert (grid.unique_name, grid.grid_class) == (grid.name, "unknown")
    assert file.grids[2].metadata["world_bbox_max"].value == (8, 5, 25)
    assert file.grids[2].metadata["voxel_count"].value == 36
    assert file.grids[2].world_bounds(0.5) == ((-4.5, 1.5, -0.5), (7.5, 4.5, 24.5))


def test_bare_buffers_say_the_same(read: Reader) -> None:
    sample = read_volume_file(str(SAMPLE))
    assert read(bare(buffers())) == sample


def test_uncompressed_grids_say_the_same(read: Reader) -> None:
    content = b""
    for grid in buffers():
        name = grid[40:296].partition(b"\0")[0] + b"\0"
        (kind,) = struct.unpack_from("<I", grid, 636)
        root = struct.unpack_from("<Q", grid, 672 + 24)[0] + 672
        content += segment(
            entry(
                name,
                kind,
                0,
                len(grid),
                struct.unpack_from("<6d", grid, 560),
                struct.unpack_from("<6i", grid, root),
                struct.unpack_from("<3d", grid, 608),
                codec=0,
            ),
            data=grid,
        )
    grids = read(content).grids
    wanted = read_volume_file(str(SAMPLE)).grids
    assert [grid.transform for grid in grids] == [grid.transform for grid in wanted]
    assert [grid.world_bounds() for grid in grids] == [grid.world_bounds() for grid in wanted]


@pytest.mark.parametrize("packed", [False, True])
def test_maps_are_read_where_they_can_be(read: Reader, packed: bool) -> None:
    turn = (0, -2, 0, 2, 0, 0, 0, 0, 3)
    grid = turned(buffers()[2], turn, (10, 20, 30))
    stored = zlib.compress(grid)
    data = struct.pack("<Q", len(stored)) + stored if packed else grid
    content = segment(entry(size=len(data), codec=int(packed)), data=data)
    (found,) = read(content).grids
    assert found.transform is not None
    assert found.transform.apply((1, 0, 0)) == (10, 22, 30)
    assert found.transform.apply((0, 1, 0)) == (8, 20, 30)
    assert found.world_bounds() == ((2, 12, 30), (6, 34, 102))
    assert read(bare([grid])).grids[0].transform == found.transform


@pytest.mark.parametrize("packed", [False, True])
def test_maps_must_be_finite(read: Reader, packed: bool) -> None:
    grid = turned(buffers()[2], (math.nan,) * 9, (0, 0, 0))
    stored = struct.pack("<Q", 0) + zlib.compress(grid) if packed else grid
    content = segment(entry(size=len(stored), codec=int(packed)), data=stored)
    assert refusal(read, content).code == "not-a-volume-file"
    assert refusal(read, bare([grid])).code == "not-a-volume-file"


def test_with_blosc_the_boxes_tell_the_transform(read: Reader) -> None:
    (grid,) = read(segment(entry(size=9), data=bytes(9))).grids
    assert (grid.value_type, grid.grid_class) == ("float", "fog volume")
    assert grid.transform is not None
    assert grid.transform.apply((-4, 2, 0)) == (-8, 4, 0)
    assert grid.world_bounds() == ((-8, 4, 0), (14, 8, 48))


@pytest.mark.parametrize(
    "world", [(-8, 4, 0, 16, 10, 51), (math.nan,) * 6, (-math.inf, 4, 0, 16, 10, 50)]
)
def test_boxes_that_do_not_fit_tell_nothing(read: Reader, world: tuple[float, ...]) -> None:
    (grid,) = read(segment(entry(world=world))).grids
    assert (grid.transform, grid.world_bounds()) == (None, None)
    assert grid.index_bounds == BOX


def test_a_grid_that_is_not_packed_as_it_says_tells_no_map(read: Reader) -> None:
    for codec in (0, 1):
        (grid,) = read(segment(entry(size=900, codec=codec), data=b"x" * 900)).grids
        assert grid.world_bounds() == ((-8, 4, 0), (14, 8, 48))


def test_empty_grids(read: Reader) -> None:
    nothing = (2**31 - 1,) * 3 + (-(2**31),) * 3
    huge = 1.7e308
    world = (huge,) * 3 + (-huge,) * 3
    (grid,) = read(segment(entry(box=nothing, world=world))).grids
    assert (grid.is_empty, grid.index_bounds, grid.world_bounds()) == (True, None, None)


@pytest.mark.parametrize(
    ("kind", "value_type", "spelt"),
    [
        (1, "float", "float"),
        (6, "vec3s", "vec3s"),
        (7, "vec3d", "vec3d"),
        (9, "half", "half"),
        (13, "float", "Fp4"),
        (16, "float", "FpN"),
        (23, "ptidx32", "ptidx32"),
        (26, "uint8", "uint8"),
        (27, "unknown", "unknown"),
        (2**32 - 1, "unknown", "unknown"),
    ],
)
def test_types(read: Reader, kind: int, value_type: str, spelt: str) -> None:
    (grid,) = read(segment(entry(kind=kind))).grids
    assert (grid.value_type, grid.tree_type, grid.registered) == (value_type, spelt, True)


def test_names(read: Reader) -> None:
    file = read(
        segment(entry(b"density\0"), entry(b"density\0"), entry(b"\0"), entry(b""))
        + segment(entry(b"density\0"), entry(b"gr\xf6\xdfe\0"), entry(b"n" * 300 + b"\0"))
    )
    assert [grid.name for grid in file.grids] == [
        *("density", "density", "", "", "density"),
        *("gr\udcf6\udcdfe", "n" * 300),
    ]


def test_versions(read: Reader) -> None:
    old, new = 31 << 21, 33 << 21 | 1
    for signature in (b"NanoVDB0", b"NanoVDB2"):
        error = refusal(read, segment(entry(), version=old, signature=signature))
        assert error.code == "version-unsupported"
        assert error.partial is not None
        assert error.partial.version == "31.0.0"
    file = read(segment(entry(), version=new))
    assert (file.version, file.newer) == ("33.0.1", "NanoVDB 33.0.1 is newer than 32")
    error = refusal(read, segment(entry(size=1), version=new))
    assert error.code == "version-unsupported"
    assert error.message.startswith(f"{file.newer}: ")


@pytest.mark.parametrize(
    ("version", "dotted"),
    [
        (0, "0.0.0"),
        (32, "0.0.32"),
        ((1 << 21) - 1, "0.2047.1023"),
        (100 << 21, "100.0.0"),
        (2**32 - 1, "2047.2047.1023"),
    ],
)
def test_versions_that_never_were_are_garbage(read: Reader, version: int, dotted: str) -> None:
    for content, at in ((segment(entry(), version=version), 8), (_bare_of(version), 16)):
        error = refusal(read, content)
        assert (error.code, error.offset) == ("not-a-volume-file", at)
        assert error.message == f"no NanoVDB writes version {dotted}"


@pytest.mark.parametrize("version", [31, 1 << 21, 31 << 21])
def test_old_versions_are_refused_as_such(read: Reader, version: int) -> None:
    assert refusal(read, segment(entry(), version=version)).code == "version-unsupported"
    assert refusal(read, _bare_of(version)).code == "version-unsupported"


def _bare_of(version: int) -> bytes:
    """A buffer with nothing but a version."""
    return struct.pack("<8sQI", b"NanoVDB1", 0, version) + bytes(700)


def test_a_few_odd_bytes_at_the_end_are_ignored(read: Reader) -> None:
    assert read(segment(entry()) + b"\n").grid_count == 1
    assert read(segment()).grids == ()


FLOAT = buffers()[2]
LIES: dict[str, tuple[bytes, str]] = {
    "cut-grid": (segment(entry(size=10), data=bytes(9)), "truncated"),
    "size-2^64": (segment(entry(size=2**64 - 1)), "truncated"),
    "more-grids": (segment(entry(), count=2), "truncated"),
    "many-grids": (segment(entry(), count=65535), "truncated"),
    "name-4-gib": (segment(entry(name_size=2**32 - 1)), "not-a-volume-file"),
    "name-cut": (segment(entry(name_size=9)), "truncated"),
    "no-segment": (segment(entry()) + bytes(16), "not-a-volume-file"),
    "bare-in-segments": (segment(entry()) + segment(signature=b"NanoVDB1"), "not-a-volume-file"),
    "bare-cut": (bare([FLOAT])[:-1], "truncated"),
    "bare-two": (bare([FLOAT, FLOAT])[: len(FLOAT)], "truncated"),
    "bare-many": (
        bare([FLOAT])[:28] + struct.pack("<I", 2**32 - 1) + bare([FLOAT])[32:],
        "not-a-volume-file",
    ),
    "bare-no-size": (
        bare([FLOAT])[:32] + struct.pack("<Q", 0) + bare([FLOAT])[40:],
        "not-a-volume-file",
    ),
    "bare-far-root": (
        bare([FLOAT])[:696] + struct.pack("<Q", 2**63) + bare([FLOAT])[704:],
        "not-a-volume-file",
    ),
    "bare-other-second": (
        bare([FLOAT, FLOAT]).replace(b"NanoVDB1", b"NanoVDB0").replace(b"NanoVDB0", b"NanoVDB1", 1),
        "not-a-volume-file",
    ),
}


@pytest.mark.parametrize(("content", "code"), LIES.values(), ids=LIES)
def test_lies_are_told(read: Reader, content: bytes, code: str) -> None:
    with memory_below(4 << 20):
        error = refusal(read, content)
    assert error.code == code
    assert error.offset is not None
    assert error.partial is not None
    assert (error.partial.version, error.partial.complete) == ("32.4.2", False)


def test_endless_segments_end(read: Reader) -> None:
    assert refusal(read, segment() * 100_001).code == "not-a-volume-file"


def test_every_cut_is_noticed() -> None:
    whole = read_volume_file(str(SAMPLE))
    content = SAMPLE.read_bytes()
    starts = {match.start() for match in re.finditer(rb"NanoVDB0", content)}
    for cut in range(1, len(content), 7):
        if cut in starts:
            continue
        error = refusal_of_file(SAMPLE, 0, cut)
        assert error.code == "truncated", cut
        if error.partial:
            names = [grid.name for grid in error.partial.grids]
            assert names == [grid.name for grid in whole.grids[: len(names)]]
    for cut in starts - {0}:  # as much is a whole file of fewer grids
        assert read_volume_file(str(SAMPLE), 0, cut).complete


@pytest.mark.parametrize("make", [SAMPLE.read_bytes, lambda: bare([FLOAT])[:1500]])
def test_every_byte_of_a_head_may_be_anything(tmp_path: Path, make: Callable[[], bytes]) -> None:
    whole, path = make()[:1500], tmp_path / "bytes"
    for start in with_each_byte_changed(whole, path):
        try:
            file = read_volume_file(str(path), start, len(whole))
        except VolumeFileError as error:
            str(error).encode()
        else:
            assert [grid.world_bounds(0.5) for grid in file.grids]


@pytest.mark.parametrize("codec", ["none", "zip", "blosc"])
@pytest.mark.parametrize("name", ["xf_affine", "xf_scaletranslate", "nostats", "class_1"])
def test_conversions_agree_with_their_source(tmp_path: Path, name: str, codec: str) -> None:
    if shutil.which("nanovdb_convert") is None:
        pytest.skip("no nanovdb_convert, which libnanovdb-tools installs")
    source, target = SAMPLES / f"{name}.vdb", tmp_path / f"{name}.nvdb"
    flag = [] if codec == "none" else [f"--{codec}"]
    done = subprocess.run(
        ["nanovdb_convert", *flag, str(source), str(target)], capture_output=True, text=True
    )
    assert target.exists(), done.stderr
    (vdb,), (nvdb,) = read_volume_file(str(source)).grids, read_volume_file(str(target)).grids
    assert (nvdb.name, nvdb.value_type, nvdb.grid_class) == (
        vdb.name,
        vdb.value_type,
        vdb.grid_class,
    )
    if name != "nostats":  # which tells no bounds
        assert nvdb.index_bounds == vdb.index_bounds
    assert vdb.transform is not None
    if codec == "blosc" and name == "xf_affine":
        assert nvdb.transform is None  # turned, and packed in a way that Python can't unpack
        return
    assert nvdb.transform is not None
    for point in ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (-13.5, 22.25, 41)):
        assert nvdb.transform.apply(point) == pytest.approx(
            vdb.transform.apply(point), rel=1e-9, abs=1e-9
        )
