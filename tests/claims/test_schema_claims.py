"""What the pages of rules/schema say of USD, asked of USD."""

from __future__ import annotations

import pytest
from answers import Said, bounds, finite, stage

BESIDE_A_CUBE = """
def Xform "World"
{
    def Volume "smoke"
    {
        float3[] extent = %s
    }

    def Cube "box"
    {
        double3 xformOp:translate = (5, 0, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
}
"""
CUBE = ((4, -1, -1), (6, 1, 1))


def test_SCH008_another_number_of_corners_is_dropped() -> None:
    for extent in ("[]", "[(0, 0, 0)]", "[(0, 0, 0), (1, 1, 1), (2, 2, 2)]"):
        asked = stage(BESIDE_A_CUBE % extent)
        with Said() as said:
            assert bounds(asked, "/World/smoke").IsEmpty()
        assert "instead of 2" in said[0]
        world = bounds(asked, "/World")
        assert (world.GetMin(), world.GetMax()) == CUBE


def test_SCH008_reversed_corners_are_empty_and_spread() -> None:
    asked = stage(BESIDE_A_CUBE % "[(1, 1, 1), (0, 0, 0)]")
    assert bounds(asked, "/World/smoke").IsEmpty()
    assert bounds(asked, "/World").GetMin() == (1, -1, -1)


@pytest.mark.parametrize("extent", ["[(0, 0, 0), (nan, 1, 1)]", "[(nan, 0, 0), (1, 1, 1)]"])
def test_SCH008_nan_does_not_spread(extent: str) -> None:
    asked = stage(BESIDE_A_CUBE % extent)
    assert not finite(bounds(asked, "/World/smoke"))
    world = bounds(asked, "/World")
    assert finite(world)
    assert world.GetMax() == CUBE[1]
    assert world.GetMin()[0] > 0


def test_SCH008_infinity_spreads() -> None:
    asked = stage(BESIDE_A_CUBE % "[(0, 0, 0), (inf, 1, 1)]")
    assert not finite(bounds(asked, "/World/smoke"))
    assert not finite(bounds(asked, "/World"))
