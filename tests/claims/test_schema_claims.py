"""What the pages of rules/schema say of USD, asked of USD."""

from __future__ import annotations

import pytest
from answers import Said, bounds, finite, stage, with_particles
from pxr import Gf, Sdf, Usd, UsdGeom, UsdVol, Vt

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


def the(text: str, path: str, **layers: str) -> Usd.Prim:
    return stage(text, **layers).GetPrimAtPath(path)


@pytest.mark.parametrize("name", ["FieldBase", "FieldAsset"])
def test_SCH002_an_abstract_type_is_none_without_a_word(name: str) -> None:
    with Said() as said:
        field = the(f'def {name} "field"\n{{\n}}\n', "/field")
        assert field.IsValid()
        assert not field.IsA(getattr(UsdVol, name))
    assert said == []


def test_SCH001_an_unknown_type_keeps_its_attributes() -> None:
    with Said() as said:
        field = the('def OpenVdbAsset "field"\n{\n    token fieldName = "heat"\n}\n', "/field")
        assert not field.IsA(UsdVol.OpenVDBAsset)
        assert field.GetAttribute("fieldName").Get() == "heat"
    assert said == []


def test_SCH003_the_schema_hides_the_type_and_converts_nothing() -> None:
    text = 'def Volume "smoke"\n{\n    double3[] extent = [(0, 0, 0), (1, 1, 1)]\n}\n'
    extent = the(text, "/smoke").GetAttribute("extent")
    assert extent.GetTypeName() == Sdf.ValueTypeNames.Float3Array
    assert isinstance(extent.Get(), Vt.Vec3dArray)
    assert bounds(stage(text), "/smoke").IsEmpty()


def test_SCH003_roles_hold_the_same_values() -> None:
    text = 'def Volume "smoke"\n{\n    color3f[] extent = [(0, 0, 0), (1, 1, 1)]\n}\n'
    assert bounds(stage(text), "/smoke").GetMax() == (1, 1, 1)


def test_SCH004_a_misspelt_name_is_custom_without_a_word() -> None:
    with Said() as said:
        field = the('def OpenVDBAsset "field"\n{\n    asset filepath = @a.vdb@\n}\n', "/field")
        assert field.GetAttribute("filePath").Get() is None
        assert "filepath" not in field.GetPrimDefinition().GetPropertyNames()
    assert said == []


IMAGEABLE = """
def Volume "smoke"
{
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    uniform token purpose = "Render"
    token visibility = "hidden"
}
"""


def test_SCH005_a_wrong_purpose_is_none_of_them() -> None:
    asked = stage(IMAGEABLE)
    smoke = asked.GetPrimAtPath("/smoke")
    assert UsdGeom.Imageable(smoke).ComputePurpose() == "Render"
    purposes = UsdGeom.Imageable.GetOrderedPurposeTokens()
    cache = UsdGeom.BBoxCache(Usd.TimeCode.Default(), purposes)
    assert cache.ComputeWorldBound(smoke).ComputeAlignedRange().IsEmpty()


def test_SCH005_a_wrong_visibility_is_inherited() -> None:
    assert UsdGeom.Imageable(the(IMAGEABLE, "/smoke")).ComputeVisibility() == "inherited"


@with_particles
def test_SCH006_the_default_of_samples_alone_is_the_fallback() -> None:
    name = "radiance:sphericalHarmonicsDegree"
    samples = f"uniform int {name}.timeSamples = {{1: 1}}"
    text = f'def ParticleField3DGaussianSplat "s"\n{{\n    {samples}\n}}\n'
    degree = the(text, "/s").GetAttribute(name)
    assert (degree.Get(), degree.Get(1)) == (3, 1)


@pytest.mark.parametrize(
    "name", ["Volume", pytest.param("ParticleField3DGaussianSplat", marks=with_particles)]
)
def test_SCH007_without_an_extent_there_are_no_bounds(name: str) -> None:
    assert bounds(stage(f'def {name} "it"\n{{\n}}\n'), "/it").IsEmpty()


def test_SCH008_no_points_have_the_empty_range() -> None:
    low, high = UsdGeom.PointBased.ComputeExtent([])
    assert low[0] == Gf.Range3f().GetMin()[0]
    assert high[0] == Gf.Range3f().GetMax()[0]


def test_SCH009_bounds_leave_out_what_is_below_a_gprim() -> None:
    inner = 'def Volume "in"\n{\n    float3[] extent = [(5, 5, 5), (9, 9, 9)]\n}\n'
    text = f'def Volume "out"\n{{\n    float3[] extent = [(0, 0, 0), (1, 1, 1)]\n{inner}}}\n'
    asked = stage(text)
    assert bounds(asked, "/out/in").GetMax() == (9, 9, 9)
    assert bounds(asked, "/out").GetMax() == (1, 1, 1)
    assert bounds(asked, "/").GetMax() == (1, 1, 1)


@with_particles
def test_SCH010_only_can_apply_asks_for_the_type() -> None:
    api = UsdVol.ParticleFieldScaleAttributeAPI
    text = 'def Mesh "it" (prepend apiSchemas = ["ParticleFieldScaleAttributeAPI"])\n{\n}\n'
    assert the(text, "/it").HasAPI(api)
    assert not api.CanApply(the('def Mesh "it"\n{\n}\n', "/it"))


@with_particles
def test_SCH010_base_apis_are_not_restricted() -> None:
    mesh = the('def Mesh "it"\n{\n}\n', "/it")
    assert UsdVol.ParticleFieldPositionBaseAPI.CanApply(mesh)


@with_particles
def test_SCH012_a_stronger_type_takes_the_built_in_apis_along() -> None:
    weak = 'def ParticleField3DGaussianSplat "s"\n{\n}\n'
    with Said() as said:
        found = the('def Xform "s" (references = @weak@</s>)\n{\n}\n', "/s", weak=weak)
        assert found.GetTypeName() == "Xform"
        assert found.GetAppliedSchemas() == []
    assert said == []


def test_SCH012_a_prim_without_a_type_takes_that_of_the_reference() -> None:
    weak = 'def Volume "s"\n{\n}\n'
    assert the('def "s" (references = @weak@</s>)\n{\n}\n', "/s", weak=weak).IsA(UsdVol.Volume)


def test_SCH012_define_prim_writes_no_type() -> None:
    asked = stage("")
    assert asked.DefinePrim("/a").GetTypeName() == ""
    assert UsdGeom.Xform.Define(asked, "/b").GetPrim().GetTypeName() == "Xform"


def test_SCH014_without_a_type_there_is_no_volume() -> None:
    with Said() as said:
        found = the('def "smoke"\n{\n    rel field:density = </d>\n}\n', "/smoke")
        assert not found.IsA(UsdVol.Volume)
    assert said == []


MOVED = """
def Volume "smoke"
{
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    double3 xformOp:scale = (%s, 2, 2)
    uniform token[] xformOpOrder = [%s]
}

def Cube "box"
{
}
"""
CALLED = "Unable to get attribute associated with the xformOp"


def test_SCH015_nan_stays_with_the_prim() -> None:
    asked = stage(MOVED % ("nan", '"xformOp:scale"'))
    assert not finite(bounds(asked, "/smoke"))
    assert bounds(asked, "/").GetMax() == (1, 1, 1)


def test_SCH015_an_op_that_is_not_there_is_left_out() -> None:
    smoke = the(MOVED % ("2", '"xformOp:translate", "xformOp:scale"'), "/smoke")
    with Said() as said:
        UsdGeom.Xformable(smoke).GetLocalTransformation()
    assert CALLED in said[0]
    with Said() as said:
        moved = UsdGeom.Xformable(smoke).ComputeLocalToWorldTransform(Usd.TimeCode.Default())
    assert said == []
    assert moved == Gf.Matrix4d().SetScale(2)


def test_SCH017_a_stronger_default_holds_at_all_times() -> None:
    weak = 'def Volume "s"\n{\n    float3[] extent.timeSamples = {1: [(0, 0, 0), (9, 9, 9)]}\n}\n'
    strong = (
        'def "s" (references = @weak@</s>)\n{\n    float3[] extent = [(0, 0, 0), (1, 1, 1)]\n}\n'
    )
    extent = the(strong, "/s", weak=weak).GetAttribute("extent")
    assert extent.GetTimeSamples() == []
    assert extent.Get(1)[1] == Gf.Vec3f(1)
