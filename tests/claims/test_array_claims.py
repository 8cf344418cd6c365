"""What the pages of rules/array say of USD, asked of USD."""

from __future__ import annotations

from answers import bounds, stage, with_particles
from pxr import Gf

SPLATS = 'def ParticleField3DGaussianSplat "splats"\n{\n    %s\n}\n'
DEGREE = "radiance:sphericalHarmonicsDegree"


@with_particles
def test_ARR004_a_degree_that_nobody_authored_is_3() -> None:
    assert stage(SPLATS % "").GetPrimAtPath("/splats").GetAttribute(DEGREE).Get() == 3


@with_particles
def test_ARR013_no_plugin_computes_the_extent() -> None:
    assert bounds(stage(SPLATS % "point3f[] positions = [(1, 2, 3)]"), "/splats").IsEmpty()


def test_ARR010_the_real_part_comes_first_in_text() -> None:
    text = 'def "splats"\n{\n    quatf[] orientations = [(1, 0, 0, 0)]\n}\n'
    found = stage(text).GetPrimAtPath("/splats").GetAttribute("orientations").Get()
    assert found[0] == Gf.Quatf(1, Gf.Vec3f(0))
    assert memoryview(found).tolist() == [[0.0, 0.0, 0.0, 1.0]]


def test_ARR025_a_stronger_default_holds_at_all_times() -> None:
    weak = 'def "splats"\n{\n    point3f[] positions.timeSamples = {1: [(1, 1, 1)]}\n}\n'
    strong = (
        'def "splats" (references = @weak@</splats>)\n{\n    point3f[] positions = [(0, 0, 0)]\n}\n'
    )
    found = stage(strong, weak=weak).GetPrimAtPath("/splats").GetAttribute("positions")
    assert found.GetTimeSamples() == []
    assert list(found.Get(1)) == [Gf.Vec3f(0)]
