"""A layer that is there and does not open is told with the reason, and the rest is checked."""

from __future__ import annotations

from pathlib import Path

import pytest
from process import run, write

ONLY = ("--isolated", "--select", "STG001,AST002,LNT", "--output-format", "json")
UNFINISHED = '#usda 1.0\ndef "X" { nonsense\n'
BROKEN = (
    "'broken.usda' can't be read: broken.usda:2:11: Expected } at 'nonsense' in </X>; "
    "what it holds was not checked"
)
BROKEN_CLIP = ("STG001", f"the clip {BROKEN}")
GONE, OTHER_GONE = (("AST002", f"no file at '{name}.vdb'") for name in ("gone", "other"))
CLIPPED = """#usda 1.0
def Volume "cloud" (
    clips = {
        dictionary default = {
            string primPath = "/X"
            asset[] assetPaths = [@broken.usda@]
            double2[] active = [(1, 0)]
            double2[] times = [(1, 1)]
            %s
        }
    }
)
{
    rel field:density = <density>

    def OpenVDBAsset "density"
    {
        asset filePath = @gone.vdb@
    }
}
"""
OTHER = """def OpenVDBAsset "other"
{
    asset filePath = @other.vdb@
}
"""


def messages(folder: Path, name: str, *arguments: str) -> list[tuple[str, str]]:
    ran = run(*ONLY, *arguments, name, cwd=folder)
    (stage,) = ran.stages
    return [(finding["code"], finding["message"]) for finding in stage["findings"]]


def test_each_arc_to_a_broken_layer_has_the_reason(tmp_path: Path) -> None:
    arcs = [f'def "R{i}" (references = @broken.usda@) {{}}' for i in range(6)]
    arcs += [f'def "P{i}" (payload = @broken.usda@) {{}}' for i in range(6)]
    write(tmp_path, broken=UNFINISHED, stage="\n".join(["#usda 1.0", *arcs]))
    expected = [("STG001", f"the {arc} {BROKEN}") for arc in ("payload", "reference")]
    assert messages(tmp_path, "stage.usda") == [each for each in expected for _ in range(6)]


def test_a_broken_clip_has_the_reason(tmp_path: Path) -> None:
    manifest = "asset manifestAssetPath = @manifest.usda@"
    write(tmp_path, broken=UNFINISHED, manifest="#usda 1.0\n", stage=CLIPPED % manifest)
    assert messages(tmp_path, "stage.usda") == [BROKEN_CLIP, GONE]


@pytest.mark.parametrize("arguments", [(), ("--load", "none"), ("--variants", "all")])
def test_a_broken_clip_without_a_manifest_hides_nothing(
    tmp_path: Path, arguments: tuple[str, ...]
) -> None:
    write(tmp_path, broken=UNFINISHED, stage=CLIPPED % "" + OTHER)
    assert messages(tmp_path, "stage.usda", *arguments) == [BROKEN_CLIP, GONE, OTHER_GONE]
