"""Who says a wrong thing again is not to blame for it, and who says another one is."""

from __future__ import annotations

from pathlib import Path

import pytest
from identities import LAYER, SPLATS, STAGE, Find, refers
from process import write

from usdvol_lint.model import Source

VOLUME = """
def Volume "tank" (
%s
)
{
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    rel field:density = </tank/density>
    def Scope "density"
    {
    }
}
"""
FIELD = """
def OpenVDBAsset "tank"
{
    asset filePath.timeSamples = { 1: @./gone.1.vdb@, 2: @./gone.2.vdb@ }
    asset filePath = None
    token fieldName = ""
    double3 xformOp:translate = (nan, 0, 0)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""
TURNED = FIELD.replace("double3 xformOp:translate = (nan, 0, 0)", "double xformOp:rotateX = nan")
TURNED = TURNED.replace("xformOp:translate", "xformOp:rotateX")
NAMELESS = 'token fieldName = ""'
EMPTY = f"{NAMELESS}\ntoken fieldName.timeSamples = {{}}"
SCALES = "float3[] scales = [(%s, 0.01, 0.01), (0.01, 0.01, 0.01)]"
NAN = SPLATS.replace("(0.01, 0.01, 0.01), (", "(nan, 0.01, 0.01), (")
APIS = 'prepend apiSchemas = ["ParticleFieldScaleAttributesAPI"]'


@pytest.mark.parametrize(
    ("asset", "code", "again", "other"),
    [
        (NAN, "ARR007", SCALES % "nan", SCALES % "inf"),
        (FIELD, "FLD001", 'token fieldName = ""', None),
        (FIELD.replace(NAMELESS, EMPTY), "FLD001", EMPTY, None),
        (
            FIELD,
            "AST002",
            "asset filePath.timeSamples = { 1: @../assets/gone.1.vdb@, 2: @../assets/gone.2.vdb@ }",
            "asset filePath.timeSamples = { 1: @../assets/gone.1.vdb@ }",
        ),
        (
            FIELD,
            "SCH015",
            "double3 xformOp:translate = (nan, 0, 0)",
            "double3 xformOp:translate = (0, nan, 0)",
        ),
        (
            TURNED,
            "SCH015",
            "double xformOp:rotateX = nan",
            "double xformOp:rotateX = inf",
        ),
        (VOLUME % "", "VOL002", 'def Xform "density" {}', None),
    ],
)
def test_a_value_is_blamed_on_who_said_it_first(
    asset: str,
    code: str,
    again: str,
    other: str | None,
    find: Find,
    shots: Path,
) -> None:
    write(shots.parent / "assets", tank=LAYER + asset)
    [alone] = find("assets/tank.usda", rules=(code,))
    assert (alone.source.layer, alone.source.path) == ("assets/tank.usda", "/tank")
    write(shots, one=STAGE + refers("a", inside=again))
    [shown] = find("shots/one.usda", rules=(code,))
    assert shown.fingerprint == alone.fingerprint
    if other:
        write(shots, two=STAGE + refers("a", inside=other))
        causes = find("shots/two.usda", rules=(code,))
        assert {cause.source.layer for cause in causes} == {"shots/two.usda"}


@pytest.mark.parametrize("edit", [APIS, 'doc = "late"', 'prepend apiSchemas = ["MotionAPI"]'])
def test_an_api_is_blamed_on_who_applied_it_first(edit: str, find: Find, shots: Path) -> None:
    write(shots.parent / "assets", tank=LAYER + SPLATS.replace('"tank"', f'"tank" ({APIS})'))
    write(shots, one=STAGE + refers("a", meta=edit))
    [alone] = find("assets/tank.usda", rules=("PRT006",))
    [shown] = find("shots/one.usda", rules=("PRT006",))
    assert shown.fingerprint == alone.fingerprint


def test_clips_are_blamed_on_who_named_them_first(find: Find, shots: Path) -> None:
    clips = """clips = { dictionary default = {
        asset[] assetPaths = [@./clip.usda@]
        string primPath = "/tank"
        double2[] active = [(1, 0)]
        double2[] times = [(1, 1)]
        asset manifestAssetPath = @./manifest.usda@
    } }"""
    assets = shots.parent / "assets"
    field = f'def OpenVDBAsset "tank" (\n{clips}\n)\n{{\n}}\n'
    over = f'over "tank" (\n{clips}\n)\n{{\n}}\n'
    clip = '#usda 1.0\nover "tank"\n{\nasset filePath%s\n}\n'
    write(
        assets,
        tank=LAYER + field,
        top=LAYER.replace("(", "(\nsubLayers = [@./tank.usda@]\n") + over,
        clip=clip % ".timeSamples = { 1: @./gone.vdb@ }",
        manifest=clip % "",
    )
    [alone] = find("assets/tank.usda")
    [shown] = find("assets/top.usda")
    assert alone.source == Source("assets/tank.usda", "/tank", "clips", ".filePath")
    assert shown.fingerprint == alone.fingerprint


def test_a_path_from_another_folder_is_another_one(find: Find, shots: Path) -> None:
    field = 'def OpenVDBAsset "tank"\n{\nasset filePath = @./gone.vdb@\n}\n'
    write(shots.parent / "assets", tank=LAYER + field)
    write(shots, one=STAGE + refers("a", inside="asset filePath = @./gone.vdb@"))
    [shown] = find("shots/one.usda")
    assert shown.source.layer == "shots/one.usda"


LOST = 'def Volume "tank" (\n    references = @./gone.usda@\n)\n{\n}\n'
SETS = """clips = {
        dictionary one = { asset[] assetPaths = [@./clip.usda@], string primPath = "/tank" }
        dictionary two = {
            asset[] assetPaths = [@./clip.usda@]
            string primPath = "tank"
            double2[] active = [(1, 0)]
        }
    }""".replace(", string", "\n            string")


@pytest.mark.parametrize("kind", ["def Volume", "over Volume", "over"])
def test_an_arc_is_blamed_on_who_had_it_first(kind: str, find: Find, shots: Path) -> None:
    assets = shots.parent / "assets"
    above = LAYER.replace("(", "(\nsubLayers = [@./tank.usda@]\n")
    write(assets, tank=LAYER + LOST, top=above + LOST.replace("def Volume", kind))
    [alone] = find("assets/tank.usda", rules=("STG001",))
    [shown] = find("assets/top.usda", rules=("STG001",))
    assert shown.fingerprint == alone.fingerprint


def test_a_range_is_blamed_on_who_said_it_first(find: Find, shots: Path) -> None:
    for number in range(1, 8):
        (shots.parent / "assets" / f"puff.{number:04}.vdb").write_bytes(b"x")
    field = 'def OpenVDBAsset "tank"\n{\nasset filePath = @./puff.0004.vdb@\n}\n'
    write(shots.parent / "assets", tank=LAYER + field)
    ranged = STAGE.replace(")", "startTimeCode = 1\nendTimeCode = 7\n)")
    write(shots, one=ranged + refers("a"))
    write(shots, two=ranged.replace("(", "(\nsubLayers = [@./one.usda@]\n"))
    [alone] = find("shots/one.usda", rules=("AST017",))
    [shown] = find("shots/two.usda", rules=("AST017",))
    assert shown.fingerprint == alone.fingerprint
    assert alone.source.layer == "shots/one.usda"


def test_two_clip_sets_are_two_causes(find: Find, shots: Path) -> None:
    field = f'def OpenVDBAsset "tank" (\n{SETS}\n)\n{{\n}}\n'
    clip = '#usda 1.0\nover "tank"\n{\nasset filePath.timeSamples = { 1: @./a.vdb@ }\n}\n'
    write(shots.parent / "assets", tank=LAYER + field, clip=clip)
    causes = find("assets/tank.usda", rules=("AST016",))
    assert sorted(cause.source.subject for cause in causes) == ["one", "two"]
