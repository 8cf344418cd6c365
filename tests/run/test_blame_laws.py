"""No layer that is clean alone is blamed, and an edit that mends nothing moves no blame."""

from __future__ import annotations

from pathlib import Path

import pytest
from identities import CLEAN, LAYER, SPLATS, STAGE, Find, refers
from process import write

from usdvol_lint.model import Severity

ALL = ("ALL",)
TWO_GRIDS = CLEAN.replace("cloud.vdb", "two_grids.vdb").replace("0.15", "-9").replace("0.65", "9")
TWO = """
def Xform "tank"
{
    def Volume "small"
    {
        float3[] extent = [(0.15, 0.15, 0.15), (0.65, 0.65, 0.65)]
        rel field:density = </tank/small/density>
        def OpenVDBAsset "density"
        {
            asset filePath = @./cloud.vdb@
            token fieldName = "density"
            token fieldDataType = "float"
            token fieldClass = "fogVolume"
        }
    }
    def Volume "large"
    {
        float3[] extent = [(0, 0, 0), (9, 9, 9)]
        rel field:density = </tank/large/density>
        def OpenVDBAsset "density"
        {
            asset filePath = @./box_growing.0003.vdb@
            token fieldName = "density"
            token fieldDataType = "float"
            token fieldClass = "fogVolume"
        }
    }
}
"""


@pytest.mark.parametrize(
    ("asset", "broken", "code", "path", "name"),
    [
        (SPLATS, "point3f[] positions = [(0.2, 0.2, 0.2)]", "ARR003", "/a", "positions"),
        (
            SPLATS,
            "point3f[] positions = [(0.2, 0.2, 0.2), (3, 3, 3)]",
            "ARR013",
            "/a",
            "positions",
        ),
        (SPLATS, "float3[] extent = [(0, 0, 0), (0.5, 0.5, 0.5)]", "ARR013", "/a", "extent"),
        (SPLATS, "float[] opacities = [1]", "ARR002", "/a", "opacities"),
        (
            SPLATS,
            "float3[] radiance:sphericalHarmonicsCoefficients (\nelementSize = 9\n)",
            "ARR015",
            "/a",
            "radiance:sphericalHarmonicsCoefficients",
        ),
        (
            SPLATS,
            'float3[] radiance:sphericalHarmonicsCoefficients (\ncolorSpace = "acse"\n)',
            "ARR016",
            "/a",
            "radiance:sphericalHarmonicsCoefficients",
        ),
        (CLEAN, 'over "density" ( active = false ) {}', "VOL008", "/a/density", None),
        (CLEAN, "float3[] extent = None", "SCH007", "/a", "extent"),
        (
            CLEAN,
            'over "density"\n{\ntoken fieldName = "fuel"\n}',
            "GRD003",
            "/a/density",
            "fieldName",
        ),
        (
            CLEAN,
            'over "density"\n{\ntoken fieldDataType = "float3"\n}',
            "GRD005",
            "/a/density",
            "fieldDataType",
        ),
        (
            CLEAN,
            "float3[] extent = [(0.15, 0.15, 0.15), (0.5, 0.65, 0.65)]",
            "VOL013",
            "/a",
            "extent",
        ),
        (CLEAN, "rel field:density = </a/gone>", "VOL001", "/a", "field:density"),
        (
            TWO_GRIDS,
            'over "density"\n{\ntoken fieldName = "velocity"\n}',
            "GRD005",
            "/a/density",
            "fieldName",
        ),
        (
            TWO,
            'over "small"\n{\nrel field:density = </a/large/density>\n}',
            "VOL013",
            "/a/small",
            "field:density",
        ),
        (
            TWO,
            'over "small"\n{\nrel field:heat = </a/large/density>\n}',
            "VOL014",
            "/a/small",
            "field:heat",
        ),
        (
            CLEAN,
            'over "density"\n{\ndouble3 xformOp:translate = (1, 0, 0)\n'
            'uniform token[] xformOpOrder = ["xformOp:translate"]\n}',
            "VOL013",
            "/a/density",
            "xformOp:translate",
        ),
        (
            CLEAN.replace(
                "token fieldName", "double3 xformOp:translate = (1, 0, 0)\ntoken fieldName"
            ),
            'over "density"\n{\nuniform token[] xformOpOrder = ["xformOp:translate"]\n}',
            "VOL013",
            "/a/density",
            "xformOpOrder",
        ),
    ],
)
def test_an_asset_that_two_shots_break_is_not_to_blame(
    asset: str,
    broken: str,
    code: str,
    path: str,
    name: str | None,
    find: Find,
    shots: Path,
) -> None:
    write(shots.parent / "assets", tank=LAYER + asset)
    shot = STAGE + refers("a", inside=broken)
    write(shots, one=shot, two=shot, whole=STAGE + refers("a"))
    clean = find("assets/tank.usda", "shots/whole.usda", rules=ALL)
    assert [cause.first.message for cause in clean] == []
    causes = find("shots/one.usda", "shots/two.usda", "assets/tank.usda", rules=ALL)
    told = [cause for cause in causes if cause.code == code]
    assert [(cause.source.layer, cause.source.path, cause.source.property) for cause in told] == [
        ("shots/one.usda", path, name),
        ("shots/two.usda", path, name),
    ]
    wrong = {cause.source.layer for cause in causes if cause.severity > Severity.INFO}
    assert wrong <= {"shots/one.usda", "shots/two.usda"}


BROKEN = """
def Volume "tank"
{
    rel field:density = </tank/density>
    rel field:heat = </tank/gone>
    rel field:both = [</tank/density>, </tank/smoke>]
    def OpenVDBAsset "density"
    {
        asset filePath = @./gone.vdb@
        token fieldClass = "fog"
    }
    def OpenVDBAsset "smoke"
    {
    }
}
"""


@pytest.mark.parametrize(
    "edit",
    [
        refers("a").replace("def ", "def Volume "),
        refers("a", inside='def OpenVDBAsset "density"\n{\n}'),
        refers("a", inside='over "density"\n{\nasset filePath (\ndoc = "late"\n)\n}'),
        refers("a", meta='doc = "edited"', inside='def Xform "more"\n{\n}'),
        refers("a", meta="instanceable = true"),
        refers("a", inside='over "density" (\nactive = true\n)\n{\n}'),
        refers("a", inside='over "density"\n{\ntoken fieldClass = "fog"\n}'),
        refers("a", inside='over "density"\n{\nasset filePath = @../assets/gone.vdb@\n}'),
        refers("a", inside="rel field:density"),
        refers("a", inside="append rel field:heat = </a/gone>"),
        refers("a", inside="delete rel field:heat = </a/other>"),
        refers("a", inside="prepend rel field:both = </a/smoke>"),
        refers("a", inside="reorder rel field:both = [</a/smoke>, </a/density>]"),
        refers("a", inside="append rel field:both = </a/third>"),
        f'def Scope "world"\n{{\n{refers("a")}}}\n',
    ],
    ids=[
        *("type", "type of field", "doc", "child", "instance", "active"),
        *("value again", "path again", "declared"),
        *("target again", "no target", "first target", "order of targets", "one more", "below"),
    ],
)
def test_an_edit_that_mends_nothing_moves_no_blame(edit: str, find: Find, shots: Path) -> None:
    write(shots.parent / "assets", tank=LAYER + BROKEN)
    write(shots, one=STAGE + edit)
    alone = {cause.fingerprint: cause.code for cause in find("assets/tank.usda", rules=ALL)}
    assert {"AST002", "AST001", "VOL001", "VOL004", "SCH007", "FLD001", "FLD002"} <= set(
        alone.values()
    )
    edited = find("shots/one.usda", rules=ALL)
    assert {cause.fingerprint: cause.code for cause in edited} == alone
