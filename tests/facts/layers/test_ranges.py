"""What brings values into a range of time that does not suit them."""

from __future__ import annotations

from pathlib import Path

import pytest
from pxr import Usd

from usdvol_lint.facts.layers.ranges import TimeRange

FIELD = (
    'def OpenVDBAsset "density"\n{\n    asset filePath = @./a.vdb@\n'
    "    asset filePath.timeSamples = {\n        1: @./1.vdb@,\n    }\n}\n"
)
SAID = "startTimeCode = 1001\nendTimeCode = 1003\n"
OTHER = "startTimeCode = 1\nendTimeCode = 3\n"
SUB = "subLayers = [@./base.usda@]\n"
CLIPS = (
    'def "a" (\nclips = {\ndictionary default = {\nasset[] assetPaths = [@./clip.usda@]\n'
    'string primPath = "/c"\ndouble2[] active = [(1, 0)]\ndouble2[] times = [(1, 1)]\n'
    'asset manifestAssetPath = @./clip.usda@\n}\n}\n)\n{\ndef OpenVDBAsset "density"\n{\n}\n}\n'
)

RANGE = TimeRange(1001.0, 1003.0)


CLIP = f'def "c"\n{{\n{FIELD}}}\n'


def header(*lines: str) -> str:
    return "(\n{}\n)\n".format("".join(lines))


def refers(layer: str, path: str = "/density", name: str = "density", arc: str = "") -> str:
    return f'def "{name}" (\nreferences = @./{layer}.usda@<{path}>{arc}\n)\n{{\n}}\n'


@pytest.mark.parametrize(
    ("layers", "expected"),
    [
        # The values lie in the layer that says the range.
        ({"stage": header(SAID) + FIELD}, None),
        ({"stage": FIELD}, None),
        # The arc out of the layer that says it, or its top where that is in a sublayer.
        ({"stage": header(SAID) + refers("base"), "base": FIELD}, "stage /density"),
        ({"stage": header(SAID) + refers("base"), "base": header(OTHER) + FIELD}, "stage /density"),
        ({"stage": header(SAID, SUB), "base": FIELD}, "stage /"),
        (
            {"stage": header(SAID, SUB), "base": refers("deep"), "deep": FIELD},
            "stage /",
        ),
        # A layer that says the same has the values at the fault; what is between has not.
        ({"stage": header(SAID) + refers("base"), "base": header(SAID) + FIELD}, None),
        (
            {
                "stage": header(SAID) + refers("base"),
                "base": header(SAID) + refers("deep"),
                "deep": FIELD,
            },
            "base /density",
        ),
        (
            {
                "stage": header(SAID) + refers("base"),
                "base": header(OTHER) + refers("deep"),
                "deep": header(SAID) + FIELD,
            },
            None,
        ),
        (
            {
                "stage": header(SAID) + refers("base"),
                "base": header(SAID, "subLayers = [@./deep.usda@]\n"),
                "deep": FIELD,
            },
            "base /",
        ),
        # The range in the time of the stage.
        (
            {
                "stage": header(SAID) + refers("base", arc=" (offset = 1000)"),
                "base": header(OTHER) + FIELD,
            },
            None,
        ),
        (
            {
                "stage": header(SAID) + refers("base"),
                "base": header("startTimeCode = 1001\n") + FIELD,
            },
            "stage /density",
        ),
        # Of value clips it is the spec that holds them.
        ({"stage": header(SAID) + CLIPS, "clip": CLIP}, None),
        (
            {"stage": header(SAID) + refers("base", "/a", "a"), "base": CLIPS, "clip": CLIP},
            "stage /a",
        ),
        ({"stage": header(SAID, SUB), "base": CLIPS, "clip": CLIP}, "stage /"),
    ],
)
@pytest.mark.parametrize("time", [1.0, None])
def test_what_brings_values_into_the_range(
    layers: dict[str, str],
    expected: str | None,
    time: float | None,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    for name, text in layers.items():
        Path(f"{name}.usda").write_text(f"#usda 1.0\n{text}", encoding="utf-8")
    stage = Usd.Stage.Open("stage.usda")
    is_clipped = "clip" in layers
    at = stage.GetPrimAtPath("/a/density" if is_clipped else "/density").GetAttribute("filePath")
    spec = RANGE.meeting(at, time, lambda other: other == RANGE)
    if is_clipped and time is None:
        assert spec is None  # clips have no default
        return
    found = spec and f"{spec.layer.GetDisplayName().removesuffix('.usda')} {spec.path}"
    assert found == expected


def test_what_has_no_value_is_brought_by_nothing() -> None:
    stage = Usd.Stage.CreateInMemory()
    prim = stage.DefinePrim("/density", "OpenVDBAsset")
    assert RANGE.meeting(prim.GetAttribute("filePath"), None, lambda other: True) is None


SAMPLES = "asset filePath.timeSamples = {\n        1: @./a.vdb@,\n        3: @./a.vdb@,\n    }"


@pytest.mark.parametrize(
    ("own", "shot", "expected"),
    [
        ((1001, 1003), (1001, 1003), None),
        ((1, 3), (1001, 1003), "shot /density"),
        ((501, 503), (1001, 1003), None),  # far from these too
        ((1, 9), (1001, 1003), "shot /density"),  # of these a part alone
        ((1, 9), (1, 20), None),
        ((1, 3), (1, 20), "shot /density"),
    ],
)
def test_samples_are_at_fault_where_no_range_suits_them(
    own: tuple[int, int],
    shot: tuple[int, int],
    expected: str | None,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    said = "(\n    startTimeCode = {}\n    endTimeCode = {}\n)\n"
    asset = f'def OpenVDBAsset "density"\n{{\n    {SAMPLES}\n}}\n'
    refers = 'def "density" (\n    references = @./asset.usda@</density>\n)\n{\n}\n'
    for name, spoken, text in (("asset", own, asset), ("shot", shot, refers)):
        Path(f"{name}.usda").write_text(f"#usda 1.0\n{said.format(*spoken)}{text}", "utf-8")
    sub = said.format(*shot).replace(")", "    subLayers = [@./asset.usda@]\n)")
    Path("sub.usda").write_text(f"#usda 1.0\n{sub}", "utf-8")
    with_sublayer = Usd.Stage.Open("sub.usda")
    at = with_sublayer.GetPrimAtPath("/density").GetAttribute("filePath")
    brought = TimeRange(*map(float, shot)).meeting_samples(at, 1.0, 3.0)
    assert (brought and str(brought.path)) == (expected and "/")
    stage = Usd.Stage.Open("shot.usda")
    at = stage.GetPrimAtPath("/density").GetAttribute("filePath")
    spec = TimeRange(*map(float, shot)).meeting_samples(at, 1.0, 3.0)
    assert (spec and f"{spec.layer.GetDisplayName()[:-5]} {spec.path}") == expected
