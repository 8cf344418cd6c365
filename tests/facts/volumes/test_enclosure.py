"""Volumes held against what their fields bring: where they stand, how far grids reach, files."""

from __future__ import annotations

import math
import shutil
from collections.abc import Callable, Iterator
from itertools import product
from pathlib import Path
from typing import Any
from unittest.mock import Mock

import pytest
import vdbwriter
from hypothesis import given
from hypothesis import strategies as st
from process import ASSETS, SAMPLES
from pxr import Gf, Sdf, Usd, UsdGeom, Vt

from usdvol_lint.config import Config, Depth
from usdvol_lint.engine.engine import Engine
from usdvol_lint.facts.prims.extents import Limits
from usdvol_lint.facts.volumes.hulls import GridBoxes, Hulls
from usdvol_lint.facts.volumes.placement import UNTRANSFORMED, Placement, read_placements
from usdvol_lint.model import Finding
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import Catalog
from usdvol_lint.volumefile import Grid, read_volume_file
from usdvol_lint.volumefile.transform import IDENTITY, Frustum, Transform, rows, scale_translate

Point = tuple[float, float, float]
Lint = Callable[..., list[Finding]]

LOW, HIGH = (-3, 2, 1), (4, 9, 6)
LOWEST, HIGHEST = (0.0, 0.0, 0.0), (8.0, 10.0, 6.0)
AFFINE = (0.2, 0.1, 0, 0, -0.1, 0.3, 0.05, 0, 0, -0.02, 0.4, 0, 5, -6, 7, 1)
TURN = (0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)
MOVED = Gf.Matrix4d(1).SetRotate(Gf.Rotation((1, 2, 3), 40)) * Gf.Matrix4d(1).SetTranslate(
    (3, 1, -2)
)


def placement_of(volume: Usd.Prim, field: Usd.Prim) -> Placement:
    [(_, placement)] = read_placements(volume, field)
    return placement


def by(numbers: tuple[float, ...]) -> Callable[[Point], Point]:
    """What a matrix of sixteen numbers does with a point, spelt out."""

    def apply(point: Point) -> Point:
        row = (*point, 1)
        x, y, z = (sum(row[k] * numbers[4 * k + j] for k in range(4)) for j in range(3))
        return x, y, z

    return apply


def frustum(taper: float, depth: float, then: Callable[[Point], Point]) -> Callable[[Point], Point]:
    def apply(point: Point) -> Point:
        (lx, ly, lz) = (high - low for low, high in zip(LOWEST, HIGHEST, strict=True))
        x, y, z = (number - low for number, low in zip(point, LOWEST, strict=True))
        z *= depth / lz
        widening = ((1 / taper - 1) / depth * z + 1) / lx
        return then(((x - lx / 2) * widening, (y - ly / 2) * widening, z))

    return apply


MAPS = {
    "AffineMap": (vdbwriter.affine(*AFFINE), by(AFFINE)),
    "UnitaryMap": (vdbwriter.affine(*TURN, kind="UnitaryMap"), by(TURN)),
    "ScaleMap": (vdbwriter.scale(2, -3, 4), lambda p: (2 * p[0], -3 * p[1], 4 * p[2])),
    "UniformScaleMap": (
        vdbwriter.scale(0.1, 0.1, 0.1, "UniformScaleMap"),
        lambda p: (0.1 * p[0], 0.1 * p[1], 0.1 * p[2]),
    ),
    "ScaleTranslateMap": (
        vdbwriter.scale_translate((2, 3, 4), (10, 20, 30)),
        lambda p: (2 * p[0] + 10, 3 * p[1] + 20, 4 * p[2] + 30),
    ),
    "UniformScaleTranslateMap": (
        vdbwriter.scale_translate((2, 2, 2), (-1, 0, 1), "UniformScaleTranslateMap"),
        lambda p: (2 * p[0] - 1, 2 * p[1], 2 * p[2] + 1),
    ),
    "TranslationMap": (
        vdbwriter.translation(0.5, -0.5, 100),
        lambda p: (p[0] + 0.5, p[1] - 0.5, p[2] + 100),
    ),
    "NonlinearFrustumMap": (
        vdbwriter.frustum(LOWEST, HIGHEST, 0.4, 3.0, vdbwriter.affine(*AFFINE)),
        frustum(0.4, 3.0, by(AFFINE)),
    ),
    "a frustum that narrows": (
        vdbwriter.frustum(LOWEST, HIGHEST, 2.5, 5.0),
        frustum(2.5, 5.0, lambda p: p),
    ),
}


def grid_with(transform: bytes, folder: Path, **bounds: Any) -> Grid:
    said = {"name": vdbwriter.string("density"), **vdbwriter.bounds(LOW, HIGH), **bounds}
    path = folder / "grid.vdb"
    path.write_bytes(vdbwriter.vdb(vdbwriter.Grid(metadata=said, transform=transform)))
    (grid,) = read_volume_file(str(path)).grids
    return grid


@pytest.mark.parametrize("matrix", [None, MOVED], ids=["where it is", "moved"])
@pytest.mark.parametrize("padding", [0.0, 0.5])
@pytest.mark.parametrize("kind", MAPS)
def test_a_grid_s_box_is_that_of_all_its_points(
    kind: str, padding: float, matrix: Any, tmp_path: Path
) -> None:
    transform, apply = MAPS[kind]
    steps = [
        [low - padding + (high - low + 2 * padding) * step / 4 for step in range(5)]
        for low, high in zip(LOW, HIGH, strict=True)
    ]
    points = [Gf.Vec3d(apply(point)) for point in product(*steps)]
    carried = [matrix.Transform(point) if matrix else point for point in points]
    wanted = [pick(point[axis] for point in carried) for pick in (min, max) for axis in range(3)]
    then = matrix and tuple(tuple(matrix.GetRow(row)) for row in range(4))
    found = grid_with(transform, tmp_path).world_bounds(padding, then)
    assert found is not None
    assert [*found[0], *found[1]] == pytest.approx(wanted, rel=1e-12, abs=1e-12)


def test_a_map_that_is_not_finite_has_no_box(tmp_path: Path) -> None:
    grid = grid_with(vdbwriter.scale(1, 1, 1), tmp_path)
    nan = tuple(tuple(math.nan if number else 0.0 for number in row) for row in IDENTITY)
    assert grid.world_bounds(then=nan) is None  # type: ignore[arg-type]


NAMES = ("world", "group", "cloud", "scope", "below", "beside", "apart")
OPS = {
    "move": "double3 xformOp:translate = (1, 2, 3)\n"
    ' uniform token[] xformOpOrder = ["xformOp:translate"]',
    "turn": 'float xformOp:rotateZ = 30\n uniform token[] xformOpOrder = ["xformOp:rotateZ"]',
    "size": 'double3 xformOp:scale = (2, 3, 4)\n uniform token[] xformOpOrder = ["xformOp:scale"]',
    "reset": "double3 xformOp:translate = (5, 0, 0)\n"
    ' uniform token[] xformOpOrder = ["!resetXformStack!", "xformOp:translate"]',
    "none": "uniform token[] xformOpOrder = []",
    "wander": "double3 xformOp:translate.timeSamples = { 1: (0, 0, 0), 3: (4, 0, 0) }\n"
    ' uniform token[] xformOpOrder = ["xformOp:translate"]',
}
HIERARCHY = """#usda 1.0
def Xform "world" {{ {world}
    def Xform "group" {{ {group}
        def Volume "cloud" {{ {cloud}
            def Scope "scope" {{ {scope}
                def OpenVDBAsset "below" {{ {below}
                }}
            }}
        }}
    }}
    def Scope "fields" {{ {scope}
        def OpenVDBAsset "beside" {{ {beside}
        }}
    }}
}}
def OpenVDBAsset "apart" {{ {apart}
}}
"""


@pytest.mark.parametrize(
    "ops",
    [
        {},
        {"world": "move", "group": "turn", "cloud": "size", "below": "move", "beside": "turn"},
        {"world": "move", "group": "none", "cloud": "none", "scope": "move", "below": "none"},
        {"world": "turn", "cloud": "reset", "below": "move", "beside": "move", "apart": "size"},
        {"world": "turn", "cloud": "move", "below": "reset", "beside": "reset", "apart": "reset"},
        {"world": "turn", "group": "size", "cloud": "reset", "below": "reset", "beside": "reset"},
        {"world": "wander", "cloud": "wander", "below": "turn", "beside": "wander"},
        {"group": "wander", "below": "wander"},
    ],
    ids=str,
)
def test_a_field_stands_where_usd_says(ops: dict[str, str]) -> None:
    text = HIERARCHY.format_map(
        {name: f"\n {OPS[ops[name]]}" if name in ops else "" for name in NAMES}
    )
    layer = Sdf.Layer.CreateAnonymous(".usda")
    layer.ImportFromString(text)
    stage = Usd.Stage.Open(layer)
    volume = stage.GetPrimAtPath("/world/group/cloud")
    for path in ("/world/group/cloud/scope/below", "/world/fields/beside", "/apart"):
        field = stage.GetPrimAtPath(path)
        placement = placement_of(volume, field)
        for time in (None, 1.0, 2.0):
            cache = UsdGeom.XformCache(Usd.TimeCode.Default() if time is None else time)
            wanted = (
                cache.GetLocalToWorldTransform(field)
                * cache.GetLocalToWorldTransform(volume).GetInverse()
            )
            found = placement.matrix(time)
            assert found is not None
            assert Gf.IsClose(Gf.Matrix4d(found), wanted, 1e-9)


COORDINATES = st.integers(-40, 40)
BOXES = st.tuples(*[st.tuples(COORDINATES, COORDINATES).map(sorted)] * 3).map(
    lambda axes: tuple(zip(*axes, strict=True))
)
TRANSFORMS = st.sampled_from(
    [
        Transform("AffineMap", rows(AFFINE)),
        Transform("UniformScaleMap", scale_translate((0.1, 0.1, 0.1), (30, 0, -30))),
        Transform("NonlinearFrustumMap", IDENTITY, Frustum((-50.0,) * 3, (50.0,) * 3, 0.5, 10.0)),
    ]
)


@given(
    boxes=st.lists(BOXES, min_size=1, max_size=5),
    transforms=st.lists(TRANSFORMS, min_size=5, max_size=5),
    side=st.integers(0, 5),
    place=st.floats(-40, 40),
)
def test_an_extent_that_frames_stick_out_of_is_never_passed_over(
    boxes: list[Any], transforms: list[Transform], side: int, place: float
) -> None:
    grids = [
        Grid("g", "g", "float", "t", index_bounds=box, transform=transform)
        for box, transform in zip(boxes, transforms, strict=False)
    ]
    timeline = Mock(select_grids=True, grids=lambda: enumerate(grids))
    sides = [-1000.0] * 3 + [1000.0] * 3
    sides[side] = place
    limits = Limits(None, [(None, Vt.Vec3fArray([tuple(sides[:3]), tuple(sides[3:])]))])
    limit = limits.at(None)
    assert limit
    overhang = Hulls(GridBoxes()).overhang(limits, [(timeline, UNTRANSFORMED)])
    for grid in grids:
        box = grid.world_bounds(0.5)
        assert box
        most = max(
            *(edge - end for edge, end in zip(limit[0], box[0], strict=True)),
            *(end - edge for edge, end in zip(limit[1], box[1], strict=True)),
        )
        assert overhang >= most / max(map(abs, (*box[0], *box[1]))) - 1e-9


def test_what_moves_both_costs_nothing() -> None:
    layer = Sdf.Layer.CreateAnonymous(".usda")
    ops = {**dict.fromkeys(NAMES, ""), "world": "\n " + OPS["wander"], "cloud": "\n " + OPS["turn"]}
    layer.ImportFromString(HIERARCHY.format_map(ops))
    stage = Usd.Stage.Open(layer)
    cloud = stage.GetPrimAtPath("/world/group/cloud")
    below = placement_of(cloud, stage.GetPrimAtPath("/world/group/cloud/scope/below"))
    assert (below.up, below.down, below.times) == ((), (), ())
    assert below.matrix(1.0) is IDENTITY
    assert placement_of(cloud, stage.GetPrimAtPath("/apart")).times == (1.0, 3.0)


@pytest.mark.parametrize("scale", ["(0, 1, 1)", "(nan, 1, 1)"])
def test_numbers_that_allow_no_place(scale: str) -> None:
    layer = Sdf.Layer.CreateAnonymous(".usda")
    op = f'double3 xformOp:scale = {scale}\n uniform token[] xformOpOrder = ["xformOp:scale"]'
    layer.ImportFromString(HIERARCHY.format_map({**dict.fromkeys(NAMES, ""), "cloud": f"\n {op}"}))
    stage = Usd.Stage.Open(layer)
    placement = placement_of(
        stage.GetPrimAtPath("/world/group/cloud"), stage.GetPrimAtPath("/apart")
    )
    assert placement.matrix(None) is None
    assert placement.displacement() is None


@pytest.fixture
def lint(catalog: Catalog, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Lint:
    """What is said of extents, of a stage that is given as text beside the examples' files."""
    monkeypatch.chdir(tmp_path)
    shutil.copytree(ASSETS, tmp_path, dirs_exist_ok=True)

    def run(text: str, code: str = "VOL013", content: str = "all", **options: Any) -> list[Finding]:
        Path("stage.usda").write_text("#usda 1.0\n" + text, encoding="utf-8")
        config = Config(select=(code,), options={code: options} if options else {})
        engine = Engine(catalog.rules, activate(config, catalog), Depth(content=content))
        return list(engine.lint("stage.usda").findings)

    return run


def volume(extent: str, files: str = "asset filePath = @./cloud.vdb@", more: str = "") -> str:
    return f"""
def Volume "cloud" {{
    {extent}
    rel field:density = </cloud/density>
    def OpenVDBAsset "density" {{
        {files}
        token fieldName = "density"
        {more}
    }}
}}
"""


def samples(files: dict[float, str]) -> str:
    return (
        "asset filePath.timeSamples = {" + "".join(f"{t}: @{f}@," for t, f in files.items()) + "}"
    )


def animated(extents: dict[float, str]) -> str:
    return (
        "float3[] extent.timeSamples = {" + "".join(f"{t}: {e}," for t, e in extents.items()) + "}"
    )


def only(findings: list[Finding]) -> Finding:
    (finding,) = findings
    return finding


UNIT = "[(0, 0, 0), (1, 1, 1)]"
POINT = "[(0, 0, 0), (0, 0, 0)]"
WHOLE = "float3[] extent = [(0.15, 0.15, 0.15), (0.65, 0.65, 0.65)]"
CENTRES = "float3[] extent = [(0.2, 0.2, 0.2), (0.6, 0.6, 0.6)]"
SMALL = "./box_growing.0002.vdb"
NAMED = 'token fieldName = "density"'
LARGE = "./box_growing.0003.vdb"


@pytest.mark.parametrize(
    ("extent", "level"),
    [
        (WHOLE, None),
        ("float3[] extent = [(0.150006, 0.15, 0.15), (0.65, 0.65, 0.649994)]", None),
        ("float3[] extent = [(0.15001, 0.15, 0.15), (0.65, 0.65, 0.65)]", "info"),
        (CENTRES, "info"),
        ("float3[] extent = [(0.200006, 0.2, 0.2), (0.6, 0.6, 0.6)]", "info"),
        ("float3[] extent = [(0.20001, 0.2, 0.2), (0.6, 0.6, 0.6)]", "error"),
        (f"float3[] extent = {POINT}", "error"),
        ("float3[] extent = [(-1e30, -1e30, -1e30), (1e30, 1e30, 1e30)]", None),
    ],
)
def test_how_much_may_be_missing(extent: str, level: str | None, lint: Lint) -> None:
    assert [finding.severity.label for finding in lint(volume(extent))] == [level][
        : level is not None
    ]


@pytest.mark.parametrize(
    "extent",
    [
        "",
        "float3[] extent",
        "float3[] extent = None",
        "float3[] extent = []",
        "float3[] extent = [(0, 0, 0)]",
        "float3[] extent = [(1, 1, 1), (0, 0, 0)]",
        "float3[] extent = [(0, 0, nan), (0, 0, 0)]",
        "float3[] extent = [(0, 0, 0), (0, inf, 0)]",
        'string extent = "large"',
    ],
)
def test_what_is_no_extent_is_another_rule_s(extent: str, lint: Lint) -> None:
    assert lint(volume(extent)) == []


def test_slack_is_an_option(lint: Lint) -> None:
    text = volume("float3[] extent = [(0.15, 0.15, 0.15), (0.65, 0.65, 0.64)]")
    assert only(lint(text)).severity.label == "info"
    assert lint(text, relative_slack=0.1) == []


def test_words_of_a_static_extent(lint: Lint) -> None:
    found = only(lint(volume("float3[] extent = [(0.2, 0.15, 0.15), (0.5, 0.5, 0.65)]")))
    assert found.message == (
        "the grid 'density' of </cloud/density> reaches out of the extent by 0.1 on +x, +y"
    )
    assert found.suggestion == "write 'float3[] extent = [(0.15, 0.15, 0.15), (0.65, 0.65, 0.65)]'"
    assert (found.site.property, found.site.line, found.site.frames) == ("extent", 4, None)


def test_words_of_half_a_voxel(lint: Lint) -> None:
    assert only(lint(volume(CENTRES))).message == (
        "the extent encloses the voxel centres of the grid 'density' of </cloud/density> and cuts "
        "voxels off by 0.05 on every side"
    )


@pytest.mark.parametrize(
    ("extent", "files", "frames"),
    [
        (WHOLE, {1: SMALL, 2: LARGE, 3: LARGE, 4: SMALL, 6: LARGE}, "2-3, 6"),
        # Interpolated between samples, held outside of them.
        (
            animated({1: UNIT, 5: POINT}),
            {1: LARGE, 2: LARGE, 3: LARGE, 4: LARGE, 9: LARGE},
            "3-5, 9",
        ),
        # A file is held too, and the sample of an extent is a time that matters.
        (
            animated({1: UNIT, 8: POINT}),
            {1: LARGE},
            "8",
        ),
        # The first file holds backwards.
        (animated({0: POINT, 4: UNIT, 6: UNIT}), {5: LARGE, 6: "./box_growing.0001.vdb"}, "0"),
        # What can not be read is not held to be what came before it.
        (
            animated({1: UNIT, 2: POINT, 3: POINT}),
            {1: LARGE, 2: "./gone.vdb", 3: "./pointer.vdb"},
            None,
        ),
        (f"float3[] extent = {POINT}", {1: "./box_growing.0001.vdb"}, None),
    ],
)
def test_frames(extent: str, files: dict[float, str], frames: str | None, lint: Lint) -> None:
    found = lint(volume(extent, samples(files)))
    assert [finding.site.frames for finding in found] == ([frames] if frames else [])


def test_words_of_frames(lint: Lint) -> None:
    found = only(lint(volume(WHOLE, samples({1: SMALL, 2: LARGE, 3: LARGE}))))
    assert found.message.endswith("by 0.05 on every side (most at frame 2, at 2 of 3 times)")


@pytest.mark.parametrize(
    ("files", "frames", "words"),
    [
        (f"asset filePath = @{LARGE}@\n{samples({1: SMALL})}", None, "1 of 2 times, the default"),
        (f"asset filePath = @{LARGE}@\n{samples({1: LARGE})}", "default, 1", "2 of 2 times, the"),
    ],
)
def test_the_default_time_counts_if_authored(
    files: str, frames: str | None, words: str, lint: Lint
) -> None:
    found = only(lint(volume(WHOLE, files)))
    assert (found.site.frames, found.site.at_default) == (frames, True)
    assert words in found.message


def test_half_a_voxel_is_not_worth_a_word_beside_more(lint: Lint) -> None:
    found = only(lint(volume(CENTRES, samples({1: SMALL, 2: LARGE}))))
    assert (found.severity.label, found.site.frames) == ("error", "2")


@pytest.mark.parametrize(
    ("extent", "suggestion"),
    [
        (f"float3[] extent = {POINT}", "float3[] extent = [(0.05,"),
        (
            animated({1: UNIT, 2: POINT}),
            "2: [(0.05, 0.05, 0.05), (0.75, 0.75, 0.75)]",
        ),
        (
            animated({1: POINT, 2: POINT}),
            "float3[] extent = [(0.05,",
        ),
    ],
)
def test_what_is_suggested_fits(extent: str, suggestion: str, lint: Lint) -> None:
    files = samples({1: SMALL, 2: LARGE})
    written = only(lint(volume(extent, files))).suggestion
    assert written is not None
    assert written.startswith(f"write '{suggestion}")
    statement = written.removeprefix("write '").removesuffix("'")
    if not statement.startswith("float3"):
        first = f"1: {UNIT}"
        statement = f"float3[] extent.timeSamples = {{ {first}, {statement} }}"
    assert lint(volume(statement, files)) == []


@pytest.mark.parametrize(
    ("low", "high", "size"),
    [
        ((-(2**30), 0, 0), (2**30, 1, 1), 1.0),
        ((0, 0, 0), (3, 3, 3), 1e-20),
        ((7, 7, 7), (7, 7, 7), 1e12),
    ],
)
def test_suggestions_fit_at_every_scale(
    low: tuple[int, int, int], high: tuple[int, int, int], size: float, lint: Lint
) -> None:
    said = {"name": vdbwriter.string("density"), **vdbwriter.bounds(low, high)}
    grid = vdbwriter.Grid(metadata=said, transform=vdbwriter.scale(size, size, size))
    Path("scaled.vdb").write_bytes(vdbwriter.vdb(grid))
    files = "asset filePath = @./scaled.vdb@"
    written = only(lint(volume(f"float3[] extent = {POINT}", files))).suggestion
    assert written is not None
    assert lint(volume(written.removeprefix("write '").removesuffix("'"), files)) == []


def test_numbers_at_the_ends_of_their_range(lint: Lint) -> None:
    for size in (5e-324, 1e-310, 1e300):
        said = {"name": vdbwriter.string("density"), **vdbwriter.bounds((0, 0, 0), (9, 9, 9))}
        grid = vdbwriter.Grid(metadata=said, transform=vdbwriter.scale(size, size, size))
        Path("scaled.vdb").write_bytes(vdbwriter.vdb(grid))
        found = lint(volume(f"float3[] extent = {POINT}", "asset filePath = @./scaled.vdb@"))
        assert only(found).code == "VOL013"


def test_the_turned_box_of_the_voxels_not_the_box_of_the_turned_box(lint: Lint) -> None:
    """A grid that is turned back by its field stands straight again."""
    root = math.sqrt(0.5)
    turned = (root, root, 0, 0, -root, root, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)
    said = {"name": vdbwriter.string("density"), **vdbwriter.bounds((0, 0, 0), (9, 9, 9))}
    grid = vdbwriter.Grid(metadata=said, transform=vdbwriter.affine(*turned))
    Path("turned.vdb").write_bytes(vdbwriter.vdb(grid))
    back = 'float xformOp:rotateZ = -45\n uniform token[] xformOpOrder = ["xformOp:rotateZ"]'
    extent = "float3[] extent = [(-0.5, -0.5, -0.5), (9.5, 9.5, 9.5)]"
    files = "asset filePath = @./turned.vdb@"
    assert lint(volume(extent, files, back)) == []
    assert only(lint(volume(extent, files))).severity.label == "error"


def test_a_field_that_moves_out_of_a_static_extent(lint: Lint) -> None:
    text = volume("float3[] extent = [(0, 0, 0), (3, 1, 1)]", more=OPS["wander"])
    assert only(lint(text)).site.frames == "3"


def test_a_scaled_field_is_named_with_its_transform(lint: Lint) -> None:
    size = 'double3 xformOp:scale = (2, 2, 2)\n uniform token[] xformOpOrder = ["xformOp:scale"]'
    found = only(lint(volume(WHOLE, more=size)))
    assert found.message.startswith(
        "the grid 'density' of </cloud/density>, moved as its field is, reaches out of the extent"
    )


def test_no_transform_that_is_not_a_number(lint: Lint) -> None:
    size = 'double3 xformOp:scale = (nan, 2, 2)\n uniform token[] xformOpOrder = ["xformOp:scale"]'
    assert lint(volume(f"float3[] extent = {POINT}", more=size)) == []


def test_one_finding_for_several_fields(lint: Lint) -> None:
    fields = "".join(
        f'def OpenVDBAsset "{name}" {{\n asset filePath = @{file}@\n {NAMED}\n}}\n'
        for name, file in (("a", SMALL), ("b", LARGE), ("c", SMALL))
    )
    rels = "".join(f"rel field:{name} = </v/{name}>\n" for name in "abc") + "rel field:d = </v/b>\n"
    found = only(
        lint(f'def Volume "v" {{\n float3[] extent = [(0, 0, 0), (0.6, 1, 1)]\n{rels}{fields}}}')
    )
    assert found.message == "the grid 'density' of </v/b> reaches out of the extent by 0.1 on +x"
    found = only(
        lint(f'def Volume "v" {{\n float3[] extent = [(0, 0, 0), (0.5, 1, 1)]\n{rels}{fields}}}')
    )
    assert found.message.endswith("by 0.2 on +x (in 3 fields)")


def test_content_that_is_not_read_is_not_compared(lint: Lint) -> None:
    text = volume(WHOLE, samples({1: SMALL, 2: LARGE}))
    assert lint(text, content="off") == []
    assert lint(text, content="first") == []
    assert (
        only(lint(volume(CENTRES, samples({1: LARGE, 2: LARGE})), content="first")).site.frames
        == "1"
    )


def test_a_grid_that_the_file_does_not_hold(lint: Lint) -> None:
    text = volume(f"float3[] extent = {POINT}").replace('"density"\n', '"heat"\n')
    assert lint(text.replace("</cloud/density>", "</cloud/heat>")) == []


def test_nanovdb_and_field3d(lint: Lint) -> None:
    for name in ("type_all_z.nvdb", "f3d_ogawa.f3d"):
        shutil.copy(SAMPLES / name, name)
    nano = volume(CENTRES, "asset filePath = @./type_all_z.nvdb@").replace('"density"\n', '"f"\n')
    assert "[(-4.5, 1.5, -0.5), (7.5, 4.5, 24.5)]" in str(only(lint(nano)).suggestion)
    f3d = volume(CENTRES, "asset filePath = @./f3d_ogawa.f3d@", 'token fieldPurpose = "cloud"')
    found = only(lint(f3d.replace("OpenVDBAsset", "Field3DAsset")))
    assert "[(0.33333, 0.375, 0.33333), (1.33334, 2.625, 2.33334)]" in str(found.suggestion)


def test_each_instance_is_no_finding_of_its_own(lint: Lint) -> None:
    small = volume(f"float3[] extent = {POINT}").replace("</cloud", "</_asset/cloud")
    instances = "".join(
        f'def "{name}" (\n instanceable = true\n inherits = </_asset>\n) {{\n}}\n'
        for name in ("a", "b")
    )
    found = only(lint(f'class "_asset" {{\n{small}\n}}\n{instances}'))
    assert "</a/cloud/density>" in found.message
    assert found.message.endswith("(shown by 2 instances)")


SHARED = """
class "_asset" {
    def Volume "cloud" {
        float3[] extent = [(0, 0, 0), (1, 1, 1)]
        rel field:density = </fields/density>
    }
}
def Scope "fields" {
    def OpenVDBAsset "density" {
        asset filePath = @./cloud.vdb@
        token fieldName = "density"
    }
}
"""
INSTANCE = 'def Xform "{0}" (\n instanceable = true\n inherits = </_asset>\n) {{ {1}\n}}\n'


def test_a_field_that_instances_share(lint: Lint) -> None:
    one = SHARED + INSTANCE.format("one", "")
    assert len(lint(one, "VOL011")) == 1
    assert lint(one + INSTANCE.format("two", ""), "VOL011") == []


def test_an_instance_that_stands_elsewhere_than_its_field(lint: Lint) -> None:
    assert lint(SHARED + INSTANCE.format("one", ""), "VOL015") == []
    found = only(lint(SHARED + INSTANCE.format("one", "\n " + OPS["move"]), "VOL015"))
    assert "its space is moved by (-1, -2, -3) in relation" in found.message


@pytest.mark.parametrize("moved", ["one", "two"])
def test_each_instance_stands_where_it_stands(moved: str, lint: Lint) -> None:
    """Whichever comes first; and what is suggested encloses the field as all of them see it."""
    instances = "".join(
        INSTANCE.format(name, "\n " + OPS["move"] if name == moved else "")
        for name in ("one", "two", "three")
    )
    found = only(lint(SHARED + instances, "VOL013"))
    assert f"moved as its field is, in </{moved}/cloud> reaches out of the extent" in found.message
    _, _, numbers = str(found.suggestion).partition("= ")
    assert lint(SHARED.replace("[(0, 0, 0), (1, 1, 1)]", numbers[:-1]) + instances, "VOL013") == []
    found = only(lint(SHARED + instances, "VOL015"))
    assert f"its space is moved by (-1, -2, -3) in </{moved}/cloud> in relation" in found.message


@pytest.mark.parametrize(
    ("ops", "words", "frames"),
    [
        (OPS["move"], "moved by (-1, -2, -3)", None),
        (OPS["turn"], "rotated or scaled", None),
        (OPS["reset"], "moved by (-5, 0, 0)", None),
        (OPS["wander"], "moved by (-4, 0, 0)", "3"),
        (OPS["none"], None, None),
        (OPS["size"].replace("(2, 3, 4)", "(0, 1, 1)"), None, None),
        (OPS["size"].replace("(2, 3, 4)", "(1, 1.0001, 1)"), "rotated or scaled", None),
        (OPS["size"].replace("(2, 3, 4)", "(1, 1.0000001, 1)"), None, None),
        (OPS["move"].replace("(1, 2, 3)", "(1e-7, 0, 0)"), None, None),
    ],
)
def test_words_of_a_displacement(
    ops: str, words: str | None, frames: str | None, lint: Lint
) -> None:
    text = SHARED.replace("class", "def").replace("float3[]", f"{ops}\n float3[]")
    found = lint(text, "VOL015")
    assert [finding.site.frames for finding in found] == ([frames] if words else [])
    assert all(f"its space is {words} in relation" in finding.message for finding in found)


def mixed(*fields: tuple[str, str]) -> Iterator[str]:
    yield 'def Volume "v" {\n float3[] extent = [(0, 0, 0), (1, 1, 1)]\n'
    for name, files in fields:
        yield f"rel field:{name} = </v/{name}>\n"
        yield f'def OpenVDBAsset "{name}" {{\n {files}\n token fieldName = "density"\n}}\n'
    yield "}\n"


ONE, TWO = "./smoke/smoke.0001.vdb", "./smoke/smoke.0002.vdb"


@pytest.mark.parametrize(
    ("fields", "frames", "words"),
    [
        ([ONE, ONE], None, None),
        ([ONE, "smoke/../smoke/smoke.0001.vdb"], None, None),
        ([ONE, "./gone.vdb"], None, None),
        ([ONE, TWO], None, f"2 files at one time, '{ONE}' (a) and '{TWO}' (b), of"),
        ([ONE, TWO, ONE], None, f"2 files at one time, '{ONE}' (a, c) and '{TWO}' (b), of"),
        (
            [ONE, TWO, "smoke/../smoke/smoke.0001.vdb"],
            None,
            f"2 files at one time, '{ONE}' (a, c) and '{TWO}' (b), of",
        ),
        (
            [ONE, TWO, SMALL, LARGE],
            None,
            f"4 files at one time, '{ONE}' (a), '{TWO}' (b) and 2 more, of",
        ),
        ([{1: ONE, 2: TWO}, {1: ONE, 2: TWO}], None, None),
        ([{1: ONE, 2: ONE, 3: TWO}, {1: ONE, 3: TWO}], None, None),
        ([{1: ONE, 2: TWO, 3: TWO}, {1: ONE, 3: TWO}], "2", f"'{TWO}' (a) and '{ONE}' (b)"),
        ([{5: ONE, 6: TWO}, ONE], "6", f"'{TWO}' (a) and '{ONE}' (b)"),
        (["omniverse:/a.vdb", "omniverse:/b.vdb"], None, "'omniverse:/a.vdb' (a) and"),
    ],
)
def test_mixed_files(fields: list[Any], frames: str | None, words: str | None, lint: Lint) -> None:
    written = [
        samples(each) if isinstance(each, dict) else f"asset filePath = @{each}@" for each in fields
    ]
    found = lint("".join(mixed(*zip("abcd", written, strict=False))), "VOL014")
    assert [finding.site.frames for finding in found] == ([frames] if words else [])
    assert all(str(words) in finding.message for finding in found)
