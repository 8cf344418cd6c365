"""Which spec holds a value, and who said it first."""

from __future__ import annotations

from pathlib import Path

import pytest
from pxr import Usd

from usdvol_lint.facts.usd.firsts import first_to_say
from usdvol_lint.facts.usd.opinions import strongest_opinion

CLIP = 'over "cloud"\n{\n    asset path%s\n}\n'
LIB = """(
    subLayers = [@./weak.usda@]
)
def "cloud" (
    clips = {
        dictionary default = {
            string primPath = "/cloud"
            asset[] assetPaths = [@./one.usda@, @./two.usda@, @./three.usda@]
            double2[] active = [(1, 0), (4, 1), (7, 2)]
        }
    }
)
{
    asset path
}
"""


@pytest.mark.parametrize("default", ["", " = @./default.vdb@"])
@pytest.mark.parametrize("metadata", ["", "subLayers = [@./lib.usda@ (offset = 2)]"])
def test_the_clip_of_a_layer_that_is_retimed_is_that_of_its_own_time(
    metadata: str, default: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whatever lies at the same time of the stage, also a clip without any sample."""
    monkeypatch.chdir(tmp_path)
    layers = {
        "weak": CLIP % default,
        "lib": LIB,
        "one": CLIP % ".timeSamples = { 1: @./a.vdb@, 2: @./b.vdb@, 3: @./c.vdb@ }",
        "two": CLIP % "",
        "three": CLIP % ".timeSamples = { 7: @./d.vdb@ }",
        "top": f"(\n    {metadata}\n)\n" if metadata else LIB,
    }
    for name, text in layers.items():
        Path(f"{name}.usda").write_text(f"#usda 1.0\n{text}", encoding="utf-8")
    stage = Usd.Stage.Open("top.usda")
    attribute = stage.GetPrimAtPath("/cloud").GetAttribute("path")
    late = 2 if metadata else 0
    for time, clip in ((1, "one"), (2, "one"), (3, "one"), (7, "three"), (9, "three")):
        for find in (strongest_opinion, first_to_say):
            found = find(attribute, time + late)
            assert found
            assert found.spec.layer.GetDisplayName() == f"{clip}.usda", (time, find)
            assert found.offset.offset == late


def test_who_says_a_value_again_is_not_the_first(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    layers = {
        "weak": 'def "a"\n{\n    int x = 1\n    asset f = @./f.vdb@\n}\n',
        "same": '(\n    subLayers = [@./weak.usda@]\n)\nover "a"\n{\n    int x = 1\n}\n',
        "top": '(\n    subLayers = [@./same.usda@]\n)\nover "a"\n{\n    int x = 2\n'
        "    asset f = @./f.vdb@\n}\n",
    }
    for name, text in layers.items():
        Path(f"{name}.usda").write_text(f"#usda 1.0\n{text}", encoding="utf-8")
    top, same = Usd.Stage.Open("top.usda"), Usd.Stage.Open("same.usda")

    def first(stage: Usd.Stage, name: str) -> str:
        found = first_to_say(stage.GetPrimAtPath("/a").GetAttribute(name), None)
        return found.spec.layer.GetDisplayName() if found else ""

    assert [first(top, "x"), first(same, "x")] == ["top.usda", "weak.usda"]
    assert first(top, "f") == "weak.usda"
    assert first_to_say(top.GetPrimAtPath("/a").GetAttribute("none"), None) is None
