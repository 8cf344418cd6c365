"""Value clips: the frames that they bring, and the layers that do not."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from stages import only, said, volume, write

from usdvol_lint.model import StageReport

Lint = Callable[..., StageReport]


CLIPS = """
(
    subLayers = [@./fx.usda@]
)
def "cloud" (
    clips = {
        dictionary default = {
            string primPath = "/cloud"
            double2[] active = [(1, 0), (3, 1), (5, 2)]
            double2[] times = [(1, 1), (6, 6)]
            asset manifestAssetPath = @./manifest.usda@
            %s
        }
    }
)
{
}
"""


def write_clips(folder: Path) -> None:
    clip = '#usda 1.0\nover "cloud"\n{{\n    over "density"\n    {{\n        {}\n    }}\n}}\n'
    (folder / "fx.usda").write_text(volume(""))
    (folder / "manifest.usda").write_text(clip.format("asset filePath"))
    for number in range(3):
        samples = "".join(f"{t}: @./{number}.{t}.vdb@,\n" for t in (2 * number + 1, 2 * number + 2))
        (folder / f"clip.{number}.usda").write_text(
            clip.format(f"asset filePath.timeSamples = {{\n{samples}}}")
        )


def test_missing_frames_in_several_clips_name_their_layers(lint_text: Lint, tmp_path: Path) -> None:
    """The line is that of the first such clip in the layer with the clips."""
    write_clips(tmp_path)
    write(tmp_path, "0.1.vdb", "0.2.vdb")
    clips = "asset[] assetPaths = [@./clip.0.usda@, @./clip.1.usda@, @./clip.2.usda@]"
    finding = only(lint_text("#usda 1.0\n" + CLIPS % clips))
    assert (finding.site.layer, finding.site.line, finding.site.frames, finding.message) == (
        "stage.usda",
        13,
        "3-6",
        "no file at './1.3.vdb' (4 of 6 samples, in 2 layers: clip.1.usda, clip.2.usda)",
    )


def test_a_clip_with_times_of_its_own(lint_text: Lint, tmp_path: Path) -> None:
    """The stage's frame is named, and the line is that of the layer with the clips."""
    write_clips(tmp_path)
    write(tmp_path, "0.1.vdb")
    clips = CLIPS.replace("(1, 0), (3, 1), (5, 2)", "(101, 0)").replace(
        "(1, 1), (6, 6)", "(101, 1), (102, 2)"
    )
    finding = only(lint_text("#usda 1.0\n" + clips % "asset[] assetPaths = [@./clip.0.usda@]"))
    assert (finding.site.layer, finding.site.line, finding.site.frames, finding.message) == (
        "stage.usda",
        13,
        "102",
        "no file at './0.2.vdb' (1 of 2 samples) (in the clip './clip.0.usda')",
    )


def test_the_sample_that_usd_adds_where_a_clip_jumps_is_none(
    lint_text: Lint, tmp_path: Path
) -> None:
    write_clips(tmp_path)
    write(tmp_path, "0.1.vdb")
    clips = CLIPS.replace("(1, 0), (3, 1), (5, 2)", "(1, 0)")
    clips = clips.replace("(1, 1), (6, 6)", "(1, 1), (3, 3), (3, 1), (4, 2)")
    finding = only(lint_text("#usda 1.0\n" + clips % "asset[] assetPaths = [@./clip.0.usda@]"))
    assert (finding.site.frames, finding.message) == (
        "2, 4",
        "no file at './0.2.vdb' (2 of 4 samples) (in the clip './clip.0.usda')",
    )


@pytest.mark.parametrize("active", ["(1, 0), (3, 1), (5, 2)", "(1, 0)"])
@pytest.mark.parametrize("manifest", ["asset manifestAssetPath = @./manifest.usda@", ""])
def test_a_clip_that_can_not_be_read(
    active: str, manifest: str, lint_text: Lint, tmp_path: Path
) -> None:
    """The field has no path then, but the layer is to blame, not the field."""
    write_clips(tmp_path)
    (tmp_path / "broken.usda").write_text("#usda 1.0\ndef (")
    broken = ", ".join(["@./broken.usda@"] * active.count("("))
    clips = CLIPS.replace("(1, 0), (3, 1), (5, 2)", active)
    clips = clips.replace("asset manifestAssetPath = @./manifest.usda@", manifest)
    assert said(lint_text("#usda 1.0\n" + clips % f"asset[] assetPaths = [{broken}]")) == [
        "STG001 the clip './broken.usda' can't be read: broken.usda:2:1: unexpected 'def (' in "
        "</>; what it holds was not checked -> correct that layer, or export it again"
    ]


@pytest.mark.parametrize("others", ["", 'def OpenVDBAsset "other"\n{\n}\n'])
def test_a_manifest_that_can_not_be_read_is_one_finding(
    others: str, lint_text: Lint, tmp_path: Path
) -> None:
    """USD raises for it where a value is first asked for, whichever field that is of."""
    write_clips(tmp_path)
    (tmp_path / "manifest.usda").write_text("#usda 1.0\ndef (")
    clips = "asset[] assetPaths = [@./clip.0.usda@, @./clip.1.usda@, @./clip.2.usda@]"
    stage = f"#usda 1.0\n{CLIPS % clips}".removesuffix("}\n") + others + "}\n"
    report = lint_text(stage)
    about = [each for each in said(report) if each[:6] not in ("FLD001", "FLD002", "VOL012")]
    assert about == [
        "STG001 the clip manifest './manifest.usda' can't be read: manifest.usda:2:1: unexpected "
        "'def (' in </>; what it holds was not checked -> correct that layer, or export it again"
    ]


def test_clips_far_above_what_they_hold(lint_text: Lint) -> None:
    others = "".join(f'def Scope "other_{number}"\n{{\n}}\n' for number in range(1000))
    text = CLIPS.replace("subLayers = [@./fx.usda@]", "").replace("{\n}\n", "{%s}\n")
    inside = others + volume("asset filePath = @./a.vdb@").removeprefix("#usda 1.0\n")
    stage = "#usda 1.0\n" + text % ("asset[] assetPaths = [@./gone.usda@]", inside)
    assert "STG001" in [finding.code for finding in lint_text(stage).findings]


def test_a_clip_template_that_fits_no_file(lint_text: Lint, tmp_path: Path) -> None:
    write_clips(tmp_path)
    template = """string templateAssetPath = "./gone.#.usda"
            double templateStartTime = 1
            double templateEndTime = 6
            double templateStride = 1"""
    assert said(lint_text("#usda 1.0\n" + CLIPS % template)) == [
        "STG001 the clip template './gone.#.usda' does not exist; what it holds was not checked"
        " -> write or copy it there, or name a layer that is there"
    ]


def test_samples_of_their_own_beside_a_clip_that_can_not_be_read(
    lint_text: Lint, tmp_path: Path
) -> None:
    """They are stronger than the clip, and checked; USD raises when asked where they stand."""
    write_clips(tmp_path)
    (tmp_path / "broken.usda").write_text("#usda 1.0\ndef (")
    clips = CLIPS.replace("(1, 0), (3, 1), (5, 2)", "(1, 0)").removesuffix("{\n}\n")
    own = 'over "density"\n{\n    asset filePath.timeSamples = {\n1: @./gone.vdb@,\n}\n}\n'
    stage = f"#usda 1.0\n{clips % 'asset[] assetPaths = [@./broken.usda@]'}{{\n{own}}}\n"
    assert said(lint_text(stage)) == [
        "STG001 the clip './broken.usda' can't be read: broken.usda:2:1: unexpected 'def (' in "
        "</>; what it holds was not checked -> correct that layer, or export it again",
        "AST002 no file at './gone.vdb' (1 of 1 samples) -> write or copy it there, or name a file "
        "that is there",
    ]


RETIMED = """#usda 1.0
def "cloud" (
    clips = {
        dictionary default = {
            string primPath = "/cloud"
            asset[] assetPaths = [@./a/clip.usda@, @./b/clip.usda@]
            double2[] active = [(1, 0), (3, 1)]
        }
    }
)
{
    def OpenVDBAsset "density"
    {
    }
}
"""


@pytest.mark.parametrize(("offset", "frame"), [(10, "13"), (-1, "2")])
def test_paths_in_retimed_clips_are_those_of_the_clip_with_the_value(
    offset: int, frame: str, lint_text: Lint, tmp_path: Path
) -> None:
    """USD anchors them at the clip of another time, and finds no file."""
    (tmp_path / "asset.usda").write_text(RETIMED)
    over = '#usda 1.0\nover "cloud"\n{{\nover "density"\n{{\n{}\n}}\n}}\n'
    for folder, first in (("a", 1), ("b", 3)):
        samples = f"{first}: @./{first}.vdb@, {first + 1}: @./{first + 1}.vdb@"
        text = over.format(f"asset filePath.timeSamples = {{{samples}}}")
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "clip.usda").write_text(text)
    write(tmp_path, "a/1.vdb", "a/2.vdb", "b/4.vdb")
    stage = f"#usda 1.0\n(\nsubLayers = [@./asset.usda@ (offset = {offset})]\n)\n"
    missing = [each for each in lint_text(stage).findings if each.code == "AST002"]
    assert [(each.site.frames, each.site.column) for each in missing] == [(frame, 52)]


def test_the_clip_of_a_hole_is_the_one_in_the_time_of_its_layer(
    lint_text: Lint, tmp_path: Path
) -> None:
    paths = "@./clip.0.usda@, @./clip.1.usda@, @./clip.2.usda@"
    write_clips(tmp_path)
    write(tmp_path, *(f"{number}.{time}.vdb" for number, time in ((0, 1), (0, 2), (2, 5), (2, 6))))
    (tmp_path / "clip.1.usda").write_text("#usda 1.0\n")
    (tmp_path / "asset.usda").write_text("#usda 1.0\n" + CLIPS % f"asset[] assetPaths = [{paths}]")
    stage = "#usda 1.0\n(\nsubLayers = [@./asset.usda@ (offset = 2)]\n)\n"
    (hole,) = (each for each in lint_text(stage).findings if each.code == "AST018")
    assert (hole.site.layer, hole.site.column) == ("asset.usda", 52)
