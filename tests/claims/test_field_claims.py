"""What the pages of rules/field say of USD, asked of USD."""

from __future__ import annotations

from answers import stage
from pxr import Usd, UsdGeom, UsdVol

FIELD = 'def OpenVDBAsset "density"\n{\n}\n'


def test_FLD001_no_fallback() -> None:
    assert stage(FIELD).GetPrimAtPath("/density").GetAttribute("fieldName").Get() is None


def test_FLD002_no_fallback() -> None:
    assert (
        UsdVol.OpenVDBAsset(stage(FIELD).GetPrimAtPath("/density")).GetFieldDataTypeAttr().Get()
        is None
    )


def test_FLD003_the_hint_falls_back_to_none() -> None:
    asked = UsdVol.OpenVDBAsset(stage(FIELD).GetPrimAtPath("/density"))
    assert asked.GetVectorDataRoleHintAttr().Get() == "None"


HIDDEN = """
def OpenVDBAsset "density" (references = @weak@</density>)
{
    %s
}
"""
SAMPLES = """
def OpenVDBAsset "density"
{
    asset filePath.timeSamples = {
        1: @./a.1.vdb@,
        2: @./a.2.vdb@,
    }
}
"""


def test_FLD006_a_stronger_default_holds_at_all_times() -> None:
    asked = stage(HIDDEN % "asset filePath = @./a.1.vdb@", weak=SAMPLES)
    path = asked.GetPrimAtPath("/density").GetAttribute("filePath")
    assert path.GetTimeSamples() == []
    assert path.Get(2).path == "./a.1.vdb"


def test_FLD006_samples_beside_a_default_win_at_their_times() -> None:
    both = SAMPLES.replace("{", "{\n    asset filePath = @./still.vdb@", 1)
    path = stage(both).GetPrimAtPath("/density").GetAttribute("filePath")
    assert path.Get(2).path == "./a.2.vdb"
    assert path.Get(Usd.TimeCode.Default()).path == "./still.vdb"


def test_FLD006_a_block_is_no_default() -> None:
    asked = stage(HIDDEN % "asset filePath = None", weak=SAMPLES)
    assert asked.GetPrimAtPath("/density").GetAttribute("filePath").Get(2) is None


def test_FLD008_a_field_has_no_extent() -> None:
    field = stage(FIELD).GetPrimAtPath("/density")
    assert field.IsA(UsdGeom.Xformable)
    assert not field.IsA(UsdGeom.Boundable)
    assert "extent" not in field.GetPrimDefinition().GetPropertyNames()
