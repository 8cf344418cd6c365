"""Where a finding points: the layer that holds the opinion, its line, the prim of the stage."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from pxr import Sdf, Usd, UsdUtils

from usdvol_lint.engine.site import Located, Sites
from usdvol_lint.model import Excerpt, Site, Source
from usdvol_lint.rule import NotChecked, Problem

Locate = Callable[..., Located]


@pytest.fixture
def locate(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Locate:
    """Where a problem is, on a stage that is given as text with the layers it names."""
    monkeypatch.chdir(tmp_path)

    def call(path: str, layers: dict[str, str], **problem: Any) -> Located:
        for name, text in layers.items():
            Path(name).parent.mkdir(parents=True, exist_ok=True)
            Path(name).write_text(f"#usda 1.0\n{text}", encoding="utf-8")
        return located(next(iter(layers)), path, **problem)

    return call


def located(stage_path: str, path: str, **problem: Any) -> Located:
    stage = Usd.Stage.Open(stage_path)
    at = stage.GetPseudoRoot() if path == "/" else stage.GetObjectAtPath(path)
    assert at
    return Sites().locate(Problem("", at=at, **problem))


DENSITY = """\
def OpenVDBAsset "density"
{
    asset filePath = @./a.vdb@
    asset filePath.timeSamples = {
        1: @./a.0001.vdb@,
        2: @./a.0002.vdb@,
        4: @./a.0004.vdb@,
    }
    rel proxyPrim = </density>
}
"""
STAGE = {"stage.usda": DENSITY}


def site(
    prim: str | None, prop: str | None, line: int, column: int, excerpt: Excerpt, **more: Any
) -> Site:
    return Site("stage.usda", prim, prop, line=line, column=column, excerpt=excerpt, **more)


HEADER = Excerpt("#usda 1.0", 1)
PRIM = Excerpt('def OpenVDBAsset "density"', 1)


def test_a_prim(locate: Locate) -> None:
    assert locate("/density", STAGE).site == site("/density", None, 2, 1, PRIM)


def test_the_stage_itself(locate: Locate) -> None:
    assert locate("/", STAGE).site == site(None, None, 1, 1, HEADER)
    assert locate("/", {"stage.usda": ""}).site == site(None, None, 1, 1, HEADER)


def test_properties(locate: Locate) -> None:
    words = Excerpt("asset filePath = @./a.vdb@", 18)
    assert locate("/density.filePath", STAGE).site == site("/density", "filePath", 4, 5, words)
    words = Excerpt("rel proxyPrim = </density>", 17)
    assert locate("/density.proxyPrim", STAGE).site == site("/density", "proxyPrim", 10, 5, words)


def test_an_attribute_that_nobody_authored_is_looked_for_at_its_prim(locate: Locate) -> None:
    assert locate("/density.fieldName", STAGE).site == site("/density", "fieldName", 2, 1, PRIM)


def test_a_time_sample_and_the_default(locate: Locate) -> None:
    words = Excerpt("2: @./a.0002.vdb@,", 4)
    expected = site("/density", "filePath", 7, 9, words, times=(2.0, 4.0))
    assert locate("/density.filePath", STAGE, times=(2.0, 4.0)).site == expected
    found = locate("/density.filePath", STAGE, times=(2.0, 4.0), at_default=True).site
    assert (found.line, found.times, found.at_default) == (4, (2.0, 4.0), True)


def test_a_time_between_samples_points_at_the_samples(locate: Locate) -> None:
    words = Excerpt("asset filePath.timeSamples = {", 1)
    expected = site("/density", "filePath", 5, 5, words, times=(3.0,))
    assert locate("/density.filePath", STAGE, times=(3.0,)).site == expected


def test_an_asset_path(locate: Locate) -> None:
    found = locate("/density.filePath", STAGE, asset="./a.vdb").site
    assert (found.line, found.column) == (4, 22)
    assert found.excerpt == Excerpt("asset filePath = @./a.vdb@", 18)
    found = locate("/density.filePath", STAGE, times=(4.0,), asset="./a.0004.vdb").site
    assert (found.line, found.column) == (8, 12)


def test_the_strongest_opinion_counts(locate: Locate) -> None:
    layers = {
        "stage.usda": "(\n    subLayers = [@./over.usda@, @./base.usda@]\n)\n",
        "over.usda": 'over "density"\n{\n    asset filePath (\n        doc = "words"\n    )\n}\n',
        "base.usda": DENSITY,
    }
    found = locate("/density.filePath", layers, times=(1.0,)).site
    assert (found.layer, found.line) == ("base.usda", 6)
    found = locate("/density", layers).site
    assert (found.layer, found.line) == ("base.usda", 2)
    layers["over.usda"] = 'over "density"\n{\n    asset filePath = @./b.vdb@\n}\n'
    found = locate("/density.filePath", layers, times=(1.0,)).site
    assert (found.layer, found.line, found.times) == ("over.usda", 4, (1.0,))


def test_targets_are_an_opinion_and_a_bare_relationship_is_none(locate: Locate) -> None:
    layers = {
        "stage.usda": "(\n    subLayers = [@./weak.usda@, @./weakest.usda@]\n)\n"
        'over "cloud"\n{\n    rel field:density\n}\n',
        "weak.usda": 'def Volume "cloud"\n{\n    rel field:density = </gone>\n}\n',
        "weakest.usda": 'over "cloud"\n{\n    rel field:density\n}\n',
    }
    found = locate("/cloud.field:density", layers).site
    assert (found.layer, found.line) == ("weak.usda", 4)


def test_times_are_the_stages_and_lines_those_of_the_layers_own_time(locate: Locate) -> None:
    layers = {
        "stage.usda": "(\n    subLayers = [@./base.usda@ (offset = 100; scale = 2)]\n)\n",
        "base.usda": DENSITY,
    }
    found = locate("/density.filePath", layers, times=(104.0, 108.0)).site
    assert (found.layer, found.line, found.times) == ("base.usda", 7, (104.0, 108.0))


def test_a_blamed_spec(locate: Locate) -> None:
    layers = {
        "stage.usda": '(\n    subLayers = [@./base.usda@]\n)\nover "density"\n{\n}\n',
        "base.usda": DENSITY,
    }
    locate("/density", layers)
    layer = Sdf.Layer.FindOrOpen("base.usda")
    spec = layer.GetAttributeAtPath("/density.filePath")
    found = locate("/density.filePath", layers, spec=spec, asset="./a.0001.vdb").site
    assert (found.layer, found.line, found.column) == ("base.usda", 6, 12)


VARIANTS = """\
def "model" (
    variants = {
        string look = "thick"
        string time = "night"
    }
    prepend variantSets = "look"
)
{
    variantSet "look" = {
        "thin" {
        }
        "thick" (
            prepend variantSets = "time"
        ) {
            def Volume "smoke"
            {
            }
            variantSet "time" = {
                "night" {
                    def Volume "dark"
                    {
                    }
                }
            }
        }
    }
}
"""


def test_variants(locate: Locate) -> None:
    found = locate("/model/smoke", {"stage.usda": VARIANTS}).site
    words = Excerpt('def Volume "smoke"', 1)
    assert found == site("/model/smoke", None, 16, 13, words, variant="look=thick")
    dark = locate("/model/dark", {"stage.usda": VARIANTS})
    assert (dark.site.variant, dark.site.line) == ("look=thick, time=night", 21)
    assert dark.source.path == "/model{look=thick}{time=night}dark"


def test_the_layer_is_named_from_the_working_directory(
    locate: Locate, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    layers = {
        "shots/stage.usda": 'def "a" (\n    references = @../lib/b.usda@</density>\n)\n{\n}\n',
        "lib/b.usda": DENSITY,
    }
    found = locate("/a", layers).site
    assert (found.layer, found.prim, found.line) == ("lib/b.usda", "/a", 2)
    monkeypatch.chdir(tmp_path / "shots")
    assert located("stage.usda", "/a").site.layer == "../lib/b.usda"


CLIPS = {
    "stage.usda": """\
(
    startTimeCode = 1
    endTimeCode = 4
)
def OpenVDBAsset "density" (
    clips = {
        dictionary default = {
            asset[] assetPaths = [@./one.usda@, @./two.usda@]
            asset manifestAssetPath = @./manifest.usda@
            string primPath = "/density"
            double2[] active = [(1, 0), (3, 1)]
            double2[] times = [(1, 1), (3, 3), (4, 4)]
        }
    }
)
{
}
""",
    "manifest.usda": 'over "density"\n{\n    asset filePath\n}\n',
    "one.usda": 'over "density"\n{\n    asset filePath.timeSamples = {\n        1: @./1.vdb@,\n'
    "        2: @./2.vdb@,\n    }\n}\n",
    "two.usda": 'over "density"\n{\n    asset filePath.timeSamples = {\n        3: @./3.vdb@,\n'
    "        4: @./4.vdb@,\n    }\n}\n",
}


def test_clips(locate: Locate, tmp_path: Path) -> None:
    """To blame is the spec that names the clips, where the line is that of the clip."""
    for time, name, column in ((1.0, "./one.usda", 23), (4.0, "./two.usda", 37)):
        found = locate("/density.filePath", CLIPS, times=(time,))
        words = Excerpt("asset[] assetPaths = [@./one.usda@, @./two.usda@]", column)
        expected = site("/density", "filePath", 9, 12 + column, words, times=(time,))
        assert (found.site, found.blame.clip) == (expected, name)
        stage = str(tmp_path.resolve() / "stage.usda")
        assert found.source == Source(stage, "/density", "clips", ".filePath")


def test_binary_layers_have_no_lines(locate: Locate, tmp_path: Path) -> None:
    locate("/density", STAGE)
    Sdf.Layer.FindOrOpen("stage.usda").Export("stage.usdc")
    found = located("stage.usdc", "/density.filePath", times=(2.0,)).site
    assert found == Site("stage.usdc", "/density", "filePath", times=(2.0,))
    (tmp_path / "named.usd").write_bytes((tmp_path / "stage.usdc").read_bytes())
    assert located("named.usd", "/density").site.line is None
    (tmp_path / "text.usd").write_bytes((tmp_path / "stage.usda").read_bytes())
    assert located("text.usd", "/density").site.line == 2


def test_layers_in_a_package(locate: Locate) -> None:
    layers = {
        "root.usda": "(\n    subLayers = [@./deep/base.usda@]\n)\n",
        "deep/base.usda": DENSITY,
    }
    for name in ("a.vdb", "a.0001.vdb", "a.0002.vdb", "a.0004.vdb"):
        Path("deep").mkdir(exist_ok=True)
        Path("deep", name).write_text("not empty")
    locate("/density", layers)
    assert UsdUtils.CreateNewUsdzPackage("root.usda", "packed.usdz")
    found = located("packed.usdz", "/density.filePath", times=(1.0,)).site
    assert found.layer.startswith("packed.usdz[")
    assert found.layer.endswith("base.usda]")
    assert (found.prim, found.line) == ("/density", 6)
    found = located("packed.usdz", "/").site
    assert (found.layer, found.line) == ("packed.usdz", 1)


def test_a_layer_without_a_file(locate: Locate) -> None:
    stage = Usd.Stage.CreateInMemory("made.usda")
    prim = stage.DefinePrim("/density", "OpenVDBAsset")
    found = Sites().locate(NotChecked("", at=prim)).site
    assert (found.prim, found.line, found.column) == ("/density", None, None)
    assert found.layer.startswith("anon:")


def test_instances_are_shown_at_the_first(locate: Locate) -> None:
    layers = {
        "stage.usda": "".join(
            f'def "{name}" (\n    instanceable = true\n    references = @./lib.usda@</lib>\n)\n'
            "{\n}\n"
            for name in ("b", "a")
        ),
        "lib.usda": f'def "lib"\n{{\n{DENSITY}}}\n',
    }
    locate("/a", layers)
    stage = Usd.Stage.Open("stage.usda")
    prim = stage.GetPrototypes()[0].GetChild("density")
    found = Sites().locate(Problem("", at=prim.GetAttribute("filePath")))
    assert found.instances == 2
    words = Excerpt("asset filePath = @./a.vdb@", 18)
    expected = site("/a/density", "filePath", 6, 5, words)
    assert found.site == expected._replace(layer="lib.usda")


def test_columns_count_characters_and_lines_end_as_on_windows(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    text = DENSITY.replace("    asset filePath =", '    string Größe = "größer" ; asset filePath =')
    (tmp_path / "stage.usda").write_text(f"#usda 1.0\n{text}", encoding="utf-8")
    found = located("stage.usda", "/density.filePath").site
    assert (found.line, found.column) == (4, 31)
    assert found.excerpt == Excerpt('string Größe = "größer" ; asset filePath = @./a.vdb@', 44)
    windows = f"#usda 1.0\n{DENSITY}".replace("\n", "\r\n").encode()
    (tmp_path / "windows.usda").write_bytes(windows)
    found = located("windows.usda", "/density.filePath", times=(2.0,)).site
    assert (found.line, found.excerpt) == (7, Excerpt("2: @./a.0002.vdb@,", 4))
