"""No layer that is clean alone is blamed, and an edit that mends nothing moves no blame."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
import vdbwriter
from identities import FILE, HEAD, Find, refers
from process import ASSETS, write

from usdvol_lint.model import Severity, Source

ALL = ("ALL",)
META = 'upAxis = "Y"\nmetersPerUnit = 1\ntimeCodesPerSecond = 24\n'
LAYER = f'#usda 1.0\n(\ndefaultPrim = "tank"\n{META})\n'
STAGE = f"#usda 1.0\n(\n{META})\n"
CLEAN = """
def Volume "tank"
{
    float3[] extent = [(0.15, 0.15, 0.15), (0.65, 0.65, 0.65)]
    rel field:density = </tank/density>
    def OpenVDBAsset "density"
    {
        asset filePath = @./cloud.vdb@
        token fieldName = "density"
        token fieldDataType = "float"
        token fieldClass = "fogVolume"
    }
}
"""
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
SPLATS = """
def ParticleField3DGaussianSplat "tank"
{
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    point3f[] positions = [(0.2, 0.2, 0.2), (0.8, 0.8, 0.8)]
    quatf[] orientations = [(1, 0, 0, 0), (1, 0, 0, 0)]
    float3[] scales = [(0.01, 0.01, 0.01), (0.01, 0.01, 0.01)]
    float[] opacities = [1, 1]
    uniform int radiance:sphericalHarmonicsDegree = 0
    float3[] radiance:sphericalHarmonicsCoefficients = [(1, 1, 1), (0.5, 0.5, 0.5)]
}
"""


@pytest.fixture
def shots(tmp_path: Path) -> Path:
    """A folder for shots beside one with the files of assets."""
    assets = Path(shutil.copytree(ASSETS, tmp_path / "assets"))
    said = {"class": vdbwriter.string("fog volume"), **vdbwriter.bounds((0, 0, 0), (1, 1, 1))}
    kinds = {"density": "Tree_float_5_4_3", "velocity": "Tree_vec3s_5_4_3"}
    grids = [
        vdbwriter.Grid(name, kind, metadata={**said, "name": vdbwriter.string(name)})
        for name, kind in kinds.items()
    ]
    (assets / "two_grids.vdb").write_bytes(vdbwriter.vdb(*grids))
    return tmp_path / "shots"


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
        refers("a", inside="rel field:density"),
        f'def Scope "world"\n{{\n{refers("a")}}}\n',
    ],
    ids=["type", "type of field", "doc", "child", "instance", "active", "declared", "below"],
)
def test_an_edit_that_mends_nothing_moves_no_blame(edit: str, find: Find, shots: Path) -> None:
    write(shots.parent / "assets", tank=LAYER + BROKEN)
    write(shots, one=STAGE + edit)
    alone = {cause.fingerprint: cause.code for cause in find("assets/tank.usda", rules=ALL)}
    assert {"AST002", "AST001", "VOL001", "SCH007", "FLD001", "FLD002"} <= set(alone.values())
    edited = find("shots/one.usda", rules=ALL)
    assert {cause.fingerprint: cause.code for cause in edited} == alone


# --- value clips and values of several layers ---

CLIPPED = """
def OpenVDBAsset "tank" (
    clips = {
        dictionary default = {
            asset[] assetPaths = [%s]
            string primPath = "/tank"
            double2[] active = [%s]
            double2[] times = [(1, 1), (4, 4)]
            asset manifestAssetPath = @./manifest.usda@
        }
    }
)
{
}
"""
CLIP = 'over "tank"\n{\nasset filePath.timeSamples = {\n%s\n}\n}\n'
BEARER = Source("assets/tank.usda", "/tank", "clips", ".filePath")


def test_a_sequence_of_clips_of_which_half_is_mended_is_no_new_cause(
    find: Find, shots: Path
) -> None:
    assets, frames = shots.parent / "assets", range(1, 5)
    paths = ", ".join(f"@./clip.{frame}.usda@" for frame in frames)
    active = ", ".join(f"({frame}, {frame - 1})" for frame in frames)
    clips = {f"clip.{n}": HEAD + CLIP % f"{n}: @./smoke.{n}.vdb@" for n in frames}
    manifest = HEAD + 'over "tank"\n{\nasset filePath\n}\n'
    write(assets, tank=LAYER + CLIPPED % (paths, active), manifest=manifest, **clips)
    write(shots, one=STAGE + refers("a"))
    [whole] = find("assets/tank.usda")
    assert (whole.source, whole.cover.frames) == (BEARER, None)
    for frame in (1, 2):
        shutil.copy(ASSETS / "cloud.vdb", assets / f"smoke.{frame}.vdb")
    [half] = find("assets/tank.usda")
    [shown] = find("shots/one.usda")
    assert half.fingerprint == whole.fingerprint == shown.fingerprint
    assert (half.cover.frames, half.first.site.layer) == ((3.0, 4.0), "assets/tank.usda")


def test_the_default_of_one_layer_and_the_samples_of_another_are_two(
    find: Find, shots: Path
) -> None:
    assets = shots.parent / "assets"
    field = 'def OpenVDBAsset "tank"\n{\nasset filePath = @./gone.vdb@\n}\n'
    write(assets, tank=LAYER + field)
    samples = "asset filePath.timeSamples = {\n1: @./gone.1.vdb@,\n2: @./gone.2.vdb@\n}"
    write(shots, one=STAGE + refers("a", inside=samples))
    causes = find("shots/one.usda", "assets/tank.usda")
    assert [
        (cause.source, cause.count, cause.cover.frames, cause.cover.at_default) for cause in causes
    ] == [
        (Source("assets/tank.usda", "/tank", "filePath"), 2, None, True),
        (Source("shots/one.usda", "/a", "filePath"), 1, None, False),
    ]
    one = STAGE + f'def OpenVDBAsset "a"\n{{\nasset filePath = @./x.vdb@\n{samples}\n}}\n'
    write(shots, both=one)
    [both] = find("shots/both.usda")
    assert (both.source.path, both.cover.frames, both.cover.at_default) == ("/a", None, True)


def test_frames_are_those_of_the_layer_to_blame(find: Find, shots: Path) -> None:
    """Whatever offset and scale a shot has it under."""
    frames = "".join(f"{frame}: @./smoke.{frame}.vdb@,\n" for frame in (1, 2, 3, 4))
    field = f'def OpenVDBAsset "tank"\n{{\nasset filePath.timeSamples = {{\n{frames}}}\n}}\n'
    write(shots.parent / "assets", tank=LAYER + field)
    for frame in (1, 3):
        shutil.copy(ASSETS / "cloud.vdb", shots.parent / "assets" / f"smoke.{frame}.vdb")
    moved = refers("a").replace(".usda@", ".usda@ (offset = 1000; scale = 2)")
    write(shots, one=STAGE + moved)
    [cause] = find("shots/one.usda", "assets/tank.usda", rules=FILE)
    assert (cause.count, cause.cover.frames) == (2, (2.0, 4.0))
    assert [place.finding.site.times for place in cause.places] == [(1004.0, 1008.0), (2.0, 4.0)]
    missing = field.replace("asset filePath.", "asset filePath = @./smoke.5.vdb@\n asset filePath.")
    write(shots.parent / "assets", tank=LAYER + missing)
    [cause] = find("shots/one.usda", "assets/tank.usda", rules=FILE)
    assert (cause.count, cause.cover.frames, cause.cover.at_default) == (2, (2.0, 4.0), True)


INSIDE, OUTSIDE = "[(0.2, 0.2, 0.2), (0.8, 0.8, 0.8)]", "[(0.2, 0.2, 0.2), (3, 3, 3)]"


def test_frames_of_what_contradicts_are_those_of_the_layer_to_blame(
    find: Find, shots: Path
) -> None:
    """Here positions of an animation, which reach out of the extent of an asset."""
    write(shots.parent / "assets", tank=LAYER + SPLATS)
    samples = f"point3f[] positions.timeSamples = {{\n1: {INSIDE},\n2: {OUTSIDE},\n}}\n"
    write(shots, animation=STAGE + f'over "a"\n{{\n{samples}}}\n')
    moved = f"{META}subLayers = [@./animation.usda@ (offset = 100)]\n"
    write(shots, one=STAGE.replace(META, moved) + refers("a"))
    [cause] = find("shots/one.usda", rules=("ARR013",))
    assert cause.source == Source("shots/animation.usda", "/a", "positions")
    [place] = cause.places
    assert (cause.cover.frames, place.finding.site.times) == ((2.0,), (102.0,))
    assert (place.finding.site.layer, place.finding.site.line) == ("shots/animation.usda", 11)


def test_clips_that_contradict_are_to_blame_as_clips(find: Find, shots: Path) -> None:
    clip = 'over "clip"\n{\npoint3f[] positions.timeSamples = {\n1: %s,\n2: %s,\n}\n}\n'
    write(shots, clip=HEAD + clip % (OUTSIDE, OUTSIDE))
    write(shots, manifest=HEAD + 'over "clip"\n{\npoint3f[] positions\n}\n')
    keys = (
        "asset[] assetPaths = [@./clip.usda@]",
        "asset manifestAssetPath = @./manifest.usda@",
        'string primPath = "/clip"',
        "double2[] active = [(1, 0)]",
        "double2[] times = [(1, 1), (2, 2)]",
    )
    meta = "clips = {{\ndictionary default = {{\n{}\n}}\n}}".format("\n".join(keys))
    write(shots, one=STAGE + refers("a", meta=meta))
    write(
        shots.parent / "assets", tank=LAYER + SPLATS.replace(f"positions = {INSIDE}", "positions")
    )
    [cause] = find("shots/one.usda", rules=("ARR013",))
    assert cause.source == Source("shots/one.usda", "/a", "clips", ".positions")
    assert cause.first.message.endswith("(in the clip './clip.usda')")
    later = refers("b", "./one.usda").replace(".usda@", ".usda@</a> (offset = 100)")
    write(shots, later=STAGE + later)
    [moved] = find("shots/later.usda", rules=("ARR013",))
    assert (moved.fingerprint, moved.cover) == (cause.fingerprint, cause.cover)
    assert [place.finding.site.times for place in moved.places] == [(101.0, 102.0)]
