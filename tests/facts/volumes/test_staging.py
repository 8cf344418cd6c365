"""Fields whose one file is held: who shows them, and what else may be said of it."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from usdvol_lint.model import StageReport

Lint = Callable[..., StageReport]
Levels = Callable[..., list[tuple[str, str]]]

HEAD = "#usda 1.0\n(\n    endTimeCode = 7\n    startTimeCode = 1\n    {}\n)\n"
FIELD = """
{} OpenVDBAsset "d"
{{
    {}
    token fieldName = "density"
    token fieldDataType = "float"
    token fieldClass = "fogVolume"
}}
"""
HELD = "asset filePath = @./puff/puff.0004.vdb@"
SAMPLES = "asset filePath.timeSamples = { 1: @./puff/puff.0001.vdb@, 2: @./puff/puff.0002.vdb@ }"
SAMPLE = "asset filePath.timeSamples = { 4: @./puff/puff.0004.vdb@ }"
MOVES = (
    "double3 xformOp:translate.timeSamples = { 1: (0, 0, 0), 7: (0, 9, 0) }\n"
    'uniform token[] xformOpOrder = ["xformOp:translate"]\n'
)
STANDS = MOVES.replace(".timeSamples = { 1: (0, 0, 0), 7: (0, 9, 0) }", " = (0, 9, 0)")
MATRIX = (
    "matrix4d xformOp:transform.timeSamples = { 1: ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), "
    "(0, 0, 0, 1)), 7: ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 9, 0, 1)) }\n"
    'uniform token[] xformOpOrder = ["xformOp:transform"]\n'
)
TURNS = (
    "float xformOp:rotateY.timeSamples = { 1: 0, 7: 360 }\n"
    'uniform token[] xformOpOrder = ["xformOp:rotateY"]\n'
)
UNUSED = MOVES.partition("uniform")[0]
FLASHES = 'token visibility.timeSamples = { 1: "invisible", 3: "inherited", 6: "invisible" }\n'


def volume(name: str, above: str = "", target: str = "/Fields/d") -> str:
    """An Xform with a Volume in it that targets a field."""
    inside = f"float3[] extent = [(0, 0, 0), (1, 1, 1)]\nrel field:d = <{target}>\n"
    return f'def Xform "{name}"\n{{\n{above}def Volume "v"\n{{\n{inside}}}\n}}\n'


@pytest.fixture
def levels(lint_text: Lint, assets: Path, tmp_path: Path) -> Levels:
    """What is said of animation, with its levels."""
    shutil.copytree(assets / "puff", tmp_path / "puff")

    def find(text: str, **layers: str) -> list[tuple[str, str]]:
        for name, layer in layers.items():
            (tmp_path / f"{name}.usda").write_text(layer)
        found = lint_text(text).findings
        about = [each for each in found if each.code in ("AST017", "FLD006")]
        return [(each.code, each.severity.label) for each in about]

    return find


@pytest.mark.parametrize(
    ("volumes", "level"),
    [
        ([volume("a")], "warning"),
        ([volume("a", STANDS)], "warning"),
        ([volume("a", MOVES)], "info"),
        ([volume("a", MATRIX)], "info"),
        ([volume("a", TURNS)], "warning"),
        ([volume("a", UNUSED)], "warning"),
        ([volume("a", MOVES), volume("b")], "warning"),
        ([volume("a", FLASHES)], "info"),
        ([volume("a", 'token visibility = "invisible"\n')], None),
        ([volume("a", 'token visibility = "invisible"\n'), volume("b", MOVES)], "info"),
        ([volume("a", 'token visibility = "invisible"\n'), volume("b")], "warning"),
        ([], "warning"),
    ],
)
def test_the_volumes_that_show_a_field_may_be_elsewhere(
    volumes: list[str], level: str | None, levels: Levels
) -> None:
    fields = f'def Scope "Fields"\n{{\n{FIELD.format("def", HELD)}}}\n'
    found = levels(HEAD.format("") + fields + "".join(volumes))
    assert found == ([("AST017", level)] if level else [])


def test_a_field_that_moves_by_itself(levels: Levels) -> None:
    fields = f'def Scope "Fields"\n{{\n{FIELD.format("def", HELD + chr(10) + MOVES)}}}\n'
    assert levels(HEAD.format("") + fields + volume("a")) == [("AST017", "info")]


def test_an_instance_that_moves(levels: Levels) -> None:
    library = volume("a", FIELD.format("def", HELD), "/a/d")
    instance = (
        f'def "i" (\n    instanceable = true\n    references = @./lib.usda@</a>\n)\n{{\n{MOVES}}}\n'
    )
    stage = HEAD.format("") + instance
    assert levels(stage, lib=f"#usda 1.0\n{library}") == [("AST017", "info")]
    assert levels(stage.replace(MOVES, ""), lib=f"#usda 1.0\n{library}") == [("AST017", "warning")]


def test_an_instancer_that_stands_still_moves_nothing(levels: Levels) -> None:
    instancer = 'def PointInstancer "i"\n{\n    point3f[] positions = [(0, 0, 0)]\n'
    library = volume("a", FIELD.format("def", HELD), "/a/d")
    stage = f"{HEAD.format('')}{instancer}    rel prototypes = </a/v>\n}}\n{library}"
    assert levels(stage) == [("AST017", "warning")]
    moving = stage.replace("positions = [(0, 0, 0)]", "positions.timeSamples = { 1: [], 2: [] }")
    assert levels(moving) == [("AST017", "info")]


@pytest.mark.parametrize(
    ("strong", "weak", "expected"),
    [
        (HELD, SAMPLES, [("FLD006", "warning")]),
        (HELD, SAMPLE, [("FLD006", "warning")]),
        (SAMPLE, SAMPLES, [("AST017", "warning")]),
        (SAMPLE, HELD, [("AST017", "warning")]),
        (HELD, HELD, [("AST017", "warning")]),
        (HELD, "", [("AST017", "warning")]),
        (SAMPLES, HELD, []),
        (f"{HELD}\n    {SAMPLES}", "", []),
    ],
)
def test_what_hides_samples_is_one_finding(
    strong: str,
    weak: str,
    expected: list[tuple[str, str]],
    levels: Levels,
) -> None:
    over = f'over "Fields"\n{{\n{FIELD.format("over", strong)}}}\n'
    field = f'def Scope "Fields"\n{{\n{FIELD.format("def", weak)}}}\n'
    stage = HEAD.format("subLayers = [@./weak.usda@]") + over
    assert levels(stage, weak=f"#usda 1.0\n{field}{volume('a')}") == expected


def test_a_sample_that_hides_those_below_it_is_one_however_it_moves(levels: Levels) -> None:
    field = f'def Scope "Fields"\n{{\n{FIELD.format("def", SAMPLES)}}}\n{volume("a", MOVES)}'
    over = f'over "Fields"\n{{\n{FIELD.format("over", SAMPLE)}}}\n'
    stage = HEAD.format("subLayers = [@./weak.usda@]") + over
    assert levels(stage, weak=f"#usda 1.0\n{field}") == [("AST017", "warning")]


CLIPS = """(
    clips = {
        dictionary default = {
            asset[] assetPaths = [@./first.usda@, @./second.usda@]
            double2[] active = [(1, 0), (2, 1)]
            string primPath = "/Fields"
            asset manifestAssetPath = @./manifest.usda@
        }
    }
)
"""


@pytest.mark.parametrize(
    ("strong", "weak", "expected"),
    [
        (HELD, "", [("FLD006", "warning")]),
        (SAMPLE, "", [("AST017", "warning")]),
        ("", HELD, [("FLD006", "warning")]),
        ("", SAMPLE, [("AST017", "warning")]),
        ("", "", []),
    ],
)
def test_what_hides_clips_is_one_finding(
    strong: str, weak: str, expected: list[tuple[str, str]], levels: Levels
) -> None:
    over = 'over "Fields"\n{{\n    over "d"\n    {{\n        {}\n    }}\n}}\n'
    sample = "asset filePath.timeSamples = {{ {0}: @./puff/puff.000{0}.vdb@ }}"
    layers = {"first": sample.format(1), "second": sample.format(2), "manifest": "asset filePath"}
    texts = {name: f"#usda 1.0\n{over.format(text)}" for name, text in layers.items()}
    field = f'def Scope "Fields" {CLIPS}{{\n{FIELD.format("def", weak)}}}\n'
    stage = HEAD.format("subLayers = [@./weak.usda@]") + over.format(strong)
    assert levels(stage, weak=f"#usda 1.0\n{field}{volume('a')}", **texts) == expected
