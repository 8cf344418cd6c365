"""Where grids and fields stand, and whether an extent encloses them: laws over any numbers."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import product
from pathlib import Path
from typing import Any
from unittest.mock import Mock

import pytest
import vdbwriter
from hypothesis import given
from hypothesis import strategies as st
from pxr import Gf, Sdf, Usd, UsdGeom, Vt
from volumetexts import OPS

from usdvol_lint.facts.prims.extents import Limits
from usdvol_lint.facts.volumes.hulls import GridBoxes, Hulls
from usdvol_lint.facts.volumes.placement import UNTRANSFORMED, Placement, read_placements
from usdvol_lint.volumefile import Grid, read_volume_file
from usdvol_lint.volumefile.transform import IDENTITY, Frustum, Transform, rows, scale_translate

Point = tuple[float, float, float]

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
    overhang = Hulls(GridBoxes({})).overhang(limits, [(timeline, UNTRANSFORMED)])
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
