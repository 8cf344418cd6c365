"""Values of clips, samples and defaults are one cause for each layer, in the time of that layer."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from identities import FILE, HEAD, LAYER, META, SPLATS, STAGE, Find, refers
from process import ASSETS, write

from usdvol_lint.model import Source

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


@pytest.mark.parametrize("retime", ["", "(offset = 1000)", "(offset = 0.1; scale = 1.001)"])
@pytest.mark.parametrize("rate", ["24", "25", "30", "29.97"])
def test_no_retime_moves_a_sample_to_its_neighbour(
    rate: str, retime: str, find: Find, shots: Path
) -> None:
    """USD takes a time of the stage back to the layer, and may end a rounding error before it."""
    frames = "".join(f"{frame}: @./smoke.{frame}.vdb@,\n" for frame in range(1, 9))
    field = f'def OpenVDBAsset "tank"\n{{\nasset filePath.timeSamples = {{\n{frames}}}\n}}\n'
    write(shots.parent / "assets", tank=LAYER + field)
    for frame in (1, 3, 4, 5, 6, 8):
        shutil.copy(ASSETS / "cloud.vdb", shots.parent / "assets" / f"smoke.{frame}.vdb")
    stage = STAGE.replace("timeCodesPerSecond = 24", f"timeCodesPerSecond = {rate}")
    write(shots, one=stage + refers("a").replace(".usda@", f".usda@ {retime}"))
    [cause] = find("shots/one.usda")
    assert cause.cover.frames == (2.0, 7.0)
    assert [len(place.finding.site.times) for place in cause.places] == [2]


def test_a_variable_of_the_shot_is_to_blame_where_it_is_said(find: Find, shots: Path) -> None:
    said = 'expressionVariables = {{\nstring TAKE = "{}"\n}}\n'
    field = 'def OpenVDBAsset "tank"\n{\nasset filePath = @`"./${TAKE}.vdb"`@\n}\n'
    own = LAYER.replace(META, META + said.format("cloud"))
    write(shots.parent / "assets", tank=own + field)
    for name in ("gone", "lost"):
        write(shots, **{name: STAGE.replace(META, META + said.format(name)) + refers("a")})
    causes = find("assets/tank.usda", "shots/gone.usda", "shots/lost.usda")
    assert [cause.source for cause in causes] == [
        Source(f"shots/{name}.usda", "/", "filePath", "/tank.filePath") for name in ("gone", "lost")
    ]
    write(shots.parent / "assets", tank=own.replace("cloud", "none") + field)
    [cause] = find("assets/tank.usda")
    assert cause.source == Source("assets/tank.usda", "/tank", "filePath")


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


def test_of_two_sets_of_clips_the_one_that_is_read_is_blamed(find: Find, shots: Path) -> None:
    """The other one's manifest does not declare the attribute."""
    assets = shots.parent / "assets"
    clips = """clips = {{ dictionary {name} = {{
        asset[] assetPaths = [@./clip.usda@]
        string primPath = "/tank"
        double2[] active = [(1, 0)]
        asset manifestAssetPath = @./{name}.usda@
    }} }}"""
    splats = SPLATS.replace(
        '"tank"',
        '"tank" (\nreferences = @./bare.usda@\n{}\n)'.replace("{}", clips.format(name="b")),
    )
    over = f'over "tank" (\n{clips.format(name="a")}\n)\n{{\n}}\n'
    above = LAYER.replace("(", "(\nsubLayers = [@./tank.usda@]\n")
    declares = HEAD + 'over "tank"\n{\n%s\n}\n'
    head, _, rest = splats.partition("    point3f[] positions")
    _, _, rest = rest.partition("\n")
    write(assets, tank=LAYER + head + rest, bare=LAYER + SPLATS, top=above + over)
    write(assets, a=declares % "", b=declares % "point3f[] positions", clip=declares % "")
    [cause] = find("assets/top.usda", rules=("ARR001",))
    assert cause.source == Source("assets/tank.usda", "/tank", "clips", ".positions")
