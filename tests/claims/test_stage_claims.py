"""What the pages of rules/stage say of USD, asked of USD."""

from __future__ import annotations

import pytest
from answers import Said, layer, stage
from pxr import Pcp, UsdGeom

ASSET = 'def "smoke"\n{\n    def OpenVDBAsset "d"\n    {\n        token fieldName = "a"\n    }\n}\n'


@pytest.mark.parametrize("target", ["@asset@</nope>", "@asset@"])
def test_STG004_an_arc_without_a_prim_brings_nothing(target: str) -> None:
    with Said() as said:
        asked = stage(f'def "it" (references = {target})\n{{\n}}\n', asset=ASSET)
    assert "Unresolved reference prim path" in said[0]
    assert asked.GetPrimAtPath("/it").GetChildren() == []
    assert [error.errorType for error in asked.GetCompositionErrors()] == [
        Pcp.ErrorType_UnresolvedPrimPath
    ]


@pytest.mark.parametrize("arc", ["inherits", "specializes"])
def test_STG004_a_class_may_be_missing(arc: str) -> None:
    with Said() as said:
        assert stage(f'def "it" ({arc} = </nope>)\n{{\n}}\n').GetCompositionErrors() == []
    assert said == []


def test_STG004_an_over_is_a_prim() -> None:
    asked = stage('def "it" (references = @asset@</o>)\n{\n}\n', asset='over "o"\n{\n}\n')
    assert asked.GetCompositionErrors() == []


def test_STG002_a_cycle_is_left_out_with_a_warning() -> None:
    with Said() as said:
        asked = stage('def "a" (references = </b>)\n{\n}\ndef "b" (references = </a>)\n{\n}\n')
    assert said
    assert asked.GetPrimAtPath("/a").IsValid()


def test_STG005_below_an_over_nothing_is_defined() -> None:
    asked = stage(ASSET.replace("def", "over", 1))
    field = asked.GetPrimAtPath("/smoke/d")
    assert (field.IsDefined(), field.HasDefiningSpecifier()) == (False, True)
    assert asked.GetCompositionErrors() == []
    assert list(asked.Traverse()) == []


def test_STG003_an_empty_stage_opens_without_a_word() -> None:
    with Said() as said:
        stage("")
    assert said == []


def test_STG001_a_missing_layer_is_a_warning() -> None:
    with Said() as said:
        asked = stage('def "it" (references = @./nope.usda@)\n{\n}\n')
    assert "Could not open asset" in said[0]
    assert asked.GetPrimAtPath("/it").IsValid()


def test_STG006_below_an_instance_nothing_is_overridden() -> None:
    inside = '    over "d"\n    {\n        token fieldName = "b"\n    }\n'
    text = (
        f'def "it" (\n    instanceable = %s\n    references = @asset@</smoke>\n)\n{{\n{inside}}}\n'
    )
    with Said() as said:
        field = stage(text % "true", asset=ASSET).GetPrimAtPath("/it/d")
        assert field.GetAttribute("fieldName").Get() == "a"
        assert len(field.GetPrimStack()) == 1
    assert said == []
    by_itself = stage(text % "false", asset=ASSET).GetPrimAtPath("/it/d")
    assert by_itself.GetAttribute("fieldName").Get() == "b"


def test_STG007_usd_compares_neither_end() -> None:
    with Said() as said:
        asked = stage("(\n    startTimeCode = 48\n    endTimeCode = 1\n)\n")
    assert (asked.GetStartTimeCode(), asked.GetEndTimeCode()) == (48, 1)
    assert said == []


CACHE = 'def "it"\n{\n    double a.timeSamples = {1: 1, 2: 2, 3: 3}\n}\n'


def times(head: str, cache: str) -> list[float]:
    asked = stage(f"(\n    {head}\n    subLayers = [@cache@]\n)\n", cache=cache)
    return list(asked.GetPrimAtPath("/it").GetAttribute("a").GetTimeSamples())


def test_STG008_times_are_scaled_by_the_rates() -> None:
    assert layer("").timeCodesPerSecond == 24
    assert times("timeCodesPerSecond = 30", CACHE) == [1.25, 2.5, 3.75]
    assert times("framesPerSecond = 30", CACHE) == [1.25, 2.5, 3.75]
    assert times("", CACHE) == [1, 2, 3]


def test_STG009_neither_axis_nor_units_are_corrected() -> None:
    other = '(\n    upAxis = "Z"\n    metersPerUnit = 0.01\n)\ndef Xform "a"\n{\n}\n'
    head = '(\n    upAxis = "Y"\n    metersPerUnit = 1\n)\n'
    asked = stage(f'{head}def "it" (references = @other@</a>)\n{{\n}}\n', other=other)
    placed = UsdGeom.Xformable(asked.GetPrimAtPath("/it"))
    assert placed.GetLocalTransformation() == placed.GetLocalTransformation().GetInverse()
    assert UsdGeom.GetStageUpAxis(asked) == "Y"


def test_STG009_an_op_counts_if_the_order_names_it() -> None:
    turned = 'def Xform "it"\n{\n    float xformOp:rotateX = -90\n%s}\n'
    order = '    uniform token[] xformOpOrder = ["xformOp:rotateX"]\n'
    for body, counts in ((order, True), ("", False)):
        placed = UsdGeom.Xformable(stage(turned % body).GetPrimAtPath("/it"))
        local = placed.GetLocalTransformation()
        assert (local != local.GetInverse()) == counts
