"""Who says a wrong thing again is not to blame for it, and who says another one is."""

from __future__ import annotations

from pathlib import Path

import pytest
from identities import LAYER, META, SPLATS, STAGE, Find, refers
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


CLIPPED = """def OpenVDBAsset "tank" (
    clips = {{ dictionary default = {{
        {names}
        string primPath = "/tank"
        double2[] active = [(1, 0)]
        double2[] times = [(1, 1)]
        asset manifestAssetPath = @./manifest.usda@
    }} }}
)
{{
}}
"""
PATHS = "asset[] assetPaths = [@./clip.1.usda@]"
TEMPLATE = """string templateAssetPath = "./clip.#.usda"
        double templateStartTime = 1
        double templateEndTime = 1
        double templateStride = 1"""


def clipped(kind: str, said: str) -> str:
    return f'{kind} "tank" (\nclips = {{ dictionary default = {{\n{said}\n}} }}\n)\n{{\n}}\n'


@pytest.fixture
def clips(shots: Path) -> Path:
    """Assets whose field has clips that name no file, in two ways."""
    clip = '#usda 1.0\nover "tank"\n{\nasset filePath%s\n}\n'
    lost = clip % ".timeSamples = { 1: @./gone.vdb@ }"
    for folder in (shots.parent / "assets", shots):
        write(folder, **{"clip.1": lost, "manifest": clip % ""})
    assets = shots.parent / "assets"
    write(assets, tank=LAYER + CLIPPED.format(names=PATHS))
    write(assets, template=LAYER + CLIPPED.format(names=TEMPLATE))
    return assets


def test_clips_that_are_others_are_not_said_again(find: Find, clips: Path) -> None:
    above = LAYER.replace("(", "(\nsubLayers = [@./tank.usda@]\n")
    others = ("double2[] times = [(1, 1), (2, 2)]", f"{PATHS}\ndouble2[] times = [(1, 1), (2, 2)]")
    for said, layer in zip(others, ("assets/tank.usda", "assets/top.usda"), strict=True):
        write(clips, top=above + clipped("over", said))
        [cause] = find("assets/top.usda")
        assert cause.source.layer == layer


def test_clips_at_other_times_are_not_said_again(find: Find, clips: Path) -> None:
    sublayers = "(\nsubLayers = [@./tank.usda@ (offset = 10)]\n"
    write(clips, top=LAYER.replace("(", sublayers) + clipped("over", PATHS))
    [cause] = find("assets/top.usda")
    assert cause.source.layer == "assets/top.usda"


@pytest.mark.parametrize(("name", "said"), [("tank", PATHS), ("template", TEMPLATE)])
def test_clips_of_another_folder_are_others(name: str, said: str, find: Find, clips: Path) -> None:
    meta = f"clips = {{ dictionary default = {{\n{said}\n}} }}"
    here = clips.parent / "shots"
    write(here, one=STAGE + refers("tank", f"../assets/{name}.usda", meta))
    write(clips, two=STAGE + refers("tank", f"./{name}.usda", meta))
    [one], [two] = find("shots/one.usda"), find("assets/two.usda")
    assert (one.source.layer, two.source.layer) == ("shots/one.usda", f"assets/{name}.usda")


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


@pytest.mark.parametrize("operator", ["", "prepend ", "append "])
def test_an_arc_is_the_same_under_any_operator(operator: str, find: Find, shots: Path) -> None:
    lost = "references = @./gone.usda@"
    write(shots, base=STAGE + f'def "a" (\n{lost}\n)\n{{\n}}\n')
    again = f'over "a" (\n{operator}{lost}\n)\n{{\n}}\n'
    write(shots, one=STAGE.replace(META, f"{META}subLayers = [@./base.usda@]\n") + again)
    [cause] = find("shots/base.usda", "shots/one.usda", rules=("STG001",))
    assert (cause.source.layer, cause.count) == ("shots/base.usda", 2)
