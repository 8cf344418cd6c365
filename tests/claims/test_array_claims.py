"""What the pages of rules/array say of USD, asked of USD."""

from __future__ import annotations

import numpy as np
import pytest
from answers import Said, bounds, stage, with_particles
from pxr import Gf, Usd, UsdGeom

SPLATS = 'def ParticleField3DGaussianSplat "splats"\n{\n    %s\n}\n'
DEGREE = "radiance:sphericalHarmonicsDegree"


@with_particles
def test_ARR004_a_degree_that_nobody_authored_is_3() -> None:
    assert stage(SPLATS % "").GetPrimAtPath("/splats").GetAttribute(DEGREE).Get() == 3


@with_particles
def test_ARR017_the_api_of_coefficients_is_built_in() -> None:
    applied = stage(SPLATS % "").GetPrimAtPath("/splats").GetAppliedSchemas()
    assert "ParticleFieldSphericalHarmonicsAttributeAPI" in applied


@with_particles
def test_ARR017_colours_for_display_are_declared_as_for_every_gprim() -> None:
    splats = stage(SPLATS % "").GetPrimAtPath("/splats")
    assert splats.IsA(UsdGeom.Gprim)
    assert splats.GetAttribute("primvars:displayColor").IsDefined()


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


def colour_space(metadata: str, own: str = "") -> tuple[str, list[str]]:
    """The colour space of a prim's coefficients, and what USD warns of."""
    lines = f'uniform token colorSpace:name = "%s"\n    float3[] c = [(0, 0, 0)] ({own})'
    name, *apis = metadata.split()
    head = f'prepend apiSchemas = ["{apis[0]}"]' if apis else ""
    asked = stage(f'def Xform "it" ({head})\n{{\n    {lines % name}\n}}\n')
    attribute = asked.GetPrimAtPath("/it").GetAttribute("c")
    with Said() as said:
        return str(Usd.ColorSpaceAPI.ComputeColorSpaceName(attribute, None)), said


@with_particles
@pytest.mark.parametrize(
    ("authored", "found", "warnings"),
    [
        ("srgb_rec709_display ColorSpaceAPI", "", 1),
        ("srgb_rec709_scene ColorSpaceAPI", "srgb_rec709_scene", 0),
        ("srgb_rec709_scene", "", 0),
    ],
)
def test_ARR016_a_name_has_to_be_known_and_the_api_applied(
    authored: str, found: str, warnings: int
) -> None:
    name, said = colour_space(authored)
    assert (name, len(said)) == (found, warnings)


@with_particles
def test_ARR016_an_own_colour_space_comes_first() -> None:
    authored = "srgb_rec709_scene ColorSpaceAPI"
    assert colour_space(authored, 'colorSpace = "lin_rec709_scene"') == ("lin_rec709_scene", [])


def test_ARR020_steps_grow_with_the_number() -> None:
    halfs = [np.spacing(np.float16(number)) for number in (100, 1500)]
    assert halfs == [0.0625, 1]
    assert np.spacing(np.float32(5_000_000)) == 0.5


def test_ARR007_a_half_ends_at_65504() -> None:
    text = 'def "it"\n{\n    half[] a = [65504, 70000]\n}\n'
    found = stage(text).GetPrimAtPath("/it").GetAttribute("a").Get()
    assert list(found) == [65504, float("inf")]
