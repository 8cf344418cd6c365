"""What the OpenVDB reader makes of what a grid may say: classes, types, bounds, maps, names."""

from __future__ import annotations

import random

import pytest
import vdbwriter as w
from attempts import Reader

from usdvol_lint.volumefile import Grid


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
