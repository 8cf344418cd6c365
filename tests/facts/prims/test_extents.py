"""Which values of `extent` are boxes, and which of them hold at a time."""

from __future__ import annotations

from math import inf, nan

import pytest
from pxr import Sdf, Usd, Vt

from usdvol_lint.facts.prims.extents import Limits, box_of

LARGEST = 3.4028234663852886e38
BOX = [(-1, -2, -3), (4, 5, 6)]


@pytest.fixture
def stage() -> Usd.Stage:
    stage = Usd.Stage.CreateInMemory()
    stage.DefinePrim("/cloud", "Volume").CreateAttribute("extent", Sdf.ValueTypeNames.Float3Array)
    return stage


def turned(axis: int, low: float, high: float) -> list[tuple[float, ...]]:
    """BOX with other limits along one axis."""
    corners = [list(corner) for corner in BOX]
    corners[0][axis], corners[1][axis] = low, high
    return [tuple(corner) for corner in corners]


@pytest.mark.parametrize("axis", range(3))
@pytest.mark.parametrize(
    ("low", "high", "is_box"),
    [
        (0, 1, True),
        (2, 2, True),  # a plane has a box too
        (1, 0, False),
        (-inf, 0, False),
        (0, inf, False),
        (nan, 0, False),
        (0, nan, False),
        (LARGEST, -LARGEST, False),  # the empty range is empty along every axis
    ],
)
def test_a_box(axis: int, low: float, high: float, is_box: bool) -> None:
    corners = turned(axis, low, high)
    assert box_of(Vt.Vec3fArray(corners)) == (tuple(corners) if is_box else None)


@pytest.mark.parametrize(
    ("value", "is_box"),
    [
        (Vt.Vec3fArray(BOX), True),
        (Vt.Vec3fArray([(LARGEST,) * 3, (-LARGEST,) * 3]), True),
        (Vt.Vec3fArray(BOX[:1]), False),
        (Vt.Vec3fArray([*BOX, (7, 8, 9)]), False),
        (Vt.Vec3dArray(BOX), False),
        (None, False),
    ],
)
def test_values_that_are_boxes(value: object, is_box: bool) -> None:
    assert (box_of(value) is not None) == is_box


@pytest.mark.parametrize(
    ("values", "are_authored", "are_malformed"),
    [
        ({None: None}, False, False),
        ({None: BOX}, True, False),
        ({None: BOX[:1]}, False, True),
        ({1: BOX, 2: BOX[:1]}, True, True),
        ({1: BOX[:1], 2: BOX[:1]}, False, True),
        ({1: BOX, 2: None}, True, False),
    ],
)
def test_what_is_known_of_all_values(
    values: dict[float | None, object],
    are_authored: bool,
    are_malformed: bool,
    stage: Usd.Stage,
) -> None:
    pairs = ((time, value and Vt.Vec3fArray(value)) for time, value in values.items())
    limits = Limits(stage.GetAttributeAtPath("/cloud.extent"), pairs)
    assert (limits.are_authored, limits.are_malformed) == (are_authored, are_malformed)


def test_between_samples_a_box_is_interpolated(stage: Usd.Stage) -> None:
    extent = stage.GetAttributeAtPath("/cloud.extent")
    samples = {1.0: [(0, 0, 0), (1, 1, 1)], 3.0: [(0, 0, 0), (3, 5, 7)]}
    for time, corners in samples.items():
        extent.Set(Vt.Vec3fArray(corners), time)
    limits = Limits(extent, [(time, Vt.Vec3fArray(value)) for time, value in samples.items()])
    boxes = [limits.at(time) for time in (0.0, 2.0, 3.0, 9.0)]
    assert boxes == [((0, 0, 0), high) for high in ((1, 1, 1), (2, 3, 4), (3, 5, 7), (3, 5, 7))]
