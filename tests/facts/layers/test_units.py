"""Layers whose up axis or units are not the stage's: what brings a place, and what corrects it."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import pytest
from pxr import Gf, Usd, UsdGeom

from usdvol_lint.model import StageReport

AXES = {"X": Gf.Vec3d.XAxis(), "Y": Gf.Vec3d.YAxis(), "Z": Gf.Vec3d.ZAxis()}
Lint = Callable[..., StageReport]
VOLUME = 'def Volume "v"\n{\n    %s\n}\n'
TURN = 'float xformOp:rotateX = -90\nuniform token[] xformOpOrder = ["xformOp:rotateX"]\n'


def found(
    lint_text: Lint, folder: Path, library: str, stage: str = "", axis: str = "Z", **more: str
) -> list[tuple[str, str | None]]:
    """The level and prim of each STG009 of a stage that references `/v` of a layer with Z up.

    And of each rule that failed on it.
    """
    (folder / "lib.usda").write_text(f'#usda 1.0\n(\n    upAxis = "{axis}"\n)\n{library}')
    for name, text in more.items():
        (folder / f"{name}.usda").write_text(f"#usda 1.0\n{text}")
    stage = stage or 'def "v" (\n    references = @./lib.usda@</v>\n)\n{\n}\n'
    report = lint_text(f'#usda 1.0\n(\n    upAxis = "Y"\n)\n{stage}')
    told = (f for f in report.findings if f.code in ("STG009", "LNT002"))
    return [(f.severity.label, f.site.prim) for f in told]


def test_a_type_alone_has_a_place(lint_text: Lint, tmp_path: Path) -> None:
    assert found(lint_text, tmp_path, VOLUME % "") == [("warning", "/v")]


def test_a_transform_alone_has_a_place(lint_text: Lint, tmp_path: Path) -> None:
    over = 'over "v"\n{\n    double3 xformOp:translate = (0, 0, 5)\n}\n'
    stage = 'def Volume "v" (\n    references = @./lib.usda@</v>\n)\n{\n}\n'
    assert found(lint_text, tmp_path, over, stage) == [("warning", "/v")]
    assert not found(lint_text, tmp_path, 'over "v"\n{\n}\n', stage)


def test_a_sublayer_that_agrees_with_the_stage(lint_text: Lint, tmp_path: Path) -> None:
    """What an asset's root layer says does not go for a sublayer that says something else."""
    top = '(\n    upAxis = "X"\n    subLayers = [@./lib.usda@]\n)\n'
    stage = 'def "v" (\n    references = @./top.usda@</v>\n)\n{\n}\n'
    assert not found(lint_text, tmp_path, VOLUME % "", stage, "Y", top=top)
    assert found(lint_text, tmp_path, VOLUME % "", stage, "Z", top=top) == [("warning", "/v")]


def test_a_volume_whose_fields_are_turned(lint_text: Lint, tmp_path: Path) -> None:
    field = 'def OpenVDBAsset "f"\n{\n    asset filePath = @./a.vdb@\n    %s}\n'
    assert not found(lint_text, tmp_path, VOLUME % (field % TURN))
    assert found(lint_text, tmp_path, VOLUME % (field % "")) == [("warning", "/v")]


def test_a_word_that_names_no_axis(lint_text: Lint, tmp_path: Path) -> None:
    assert not found(lint_text, tmp_path, VOLUME % "", axis="up")


ANIMATED = """
    {type} xformOp:{op}.timeSamples = {{
        1: {first},
        2: {last},
    }}
    uniform token[] xformOpOrder = ["xformOp:{op}"]
"""
SCALED = ANIMATED.format(type="float3", op="scale", first="(1, 1, 1)", last="(2, 2, 2)")
TURNED = ANIMATED.format(type="float", op="rotateZ", first=0, last=90)


@pytest.mark.parametrize(
    ("body", "left"), [(SCALED, ["upAxis"]), (TURNED, ["metersPerUnit"]), ("", ["me", "up"])]
)
def test_what_is_animated_turns_or_scales_but_not_both(
    body: str, left: list[str], lint_text: Lint, tmp_path: Path
) -> None:
    header = '#usda 1.0\n(\n    metersPerUnit = {}\n    upAxis = "{}"\n)\n'
    (tmp_path / "lib.usda").write_text(header.format(0.01, "Z") + VOLUME % "")
    stage = f'def "v" (\n    references = @./lib.usda@</v>\n)\n{{\n{body}}}\n'
    report = lint_text(header.format(1, "Y") + stage)
    found = sorted(f.message for f in report.findings if f.code == "STG009")
    assert len(found) == len(left)
    assert all(f"the layer's {key}" in each for each, key in zip(found, left, strict=True))


@pytest.mark.parametrize("body", ["", TURN])
def test_instances(body: str, lint_text: Lint, tmp_path: Path) -> None:
    stage = (
        'def Xform "i" (\n    instanceable = true\n    references = @./lib.usda@</set>\n)\n'
        f"{{\n{body}}}\n"
    )
    library = f'def Xform "set"\n{{\n    {VOLUME % ""}}}\n'
    expected = [] if body else [("warning", "/i/v")]
    assert found(lint_text, tmp_path, library, stage) == expected


@pytest.mark.parametrize("own", [None, "X", "Y", "Z"], ids=["units", "from_x", "from_y", "from_z"])
@pytest.mark.parametrize("wanted", ["X", "Y", "Z"])
def test_advice_followed(own: str | None, wanted: str, lint_text: Lint, tmp_path: Path) -> None:
    header = '#usda 1.0\n(\n    metersPerUnit = {}\n    upAxis = "{}"\n)\n'
    (tmp_path / "lib.usda").write_text(header.format(1, own or wanted) + VOLUME % "")
    stage = header.format(1 if own else 4, wanted)
    stage += 'def "v" (\n    references = @./lib.usda@</v>\n)\n{\n    %s\n}\n'
    findings = [each for each in lint_text(stage % "").findings if each.code == "STG009"]
    if own == wanted:
        assert not findings
        return
    [finding] = findings
    op, order = re.findall("'([^']+)'", finding.suggestion or "")
    followed = stage % f"{op}\n    {order}"
    assert "STG009" not in [each.code for each in lint_text(followed).findings]
    (tmp_path / "followed.usda").write_text(followed)
    asked = Usd.Stage.Open(str(tmp_path / "followed.usda"))
    placed = UsdGeom.Xformable(asked.GetPrimAtPath("/v"))
    up = placed.GetLocalTransformation().TransformDir(AXES[own or wanted])
    assert Gf.IsClose(up, AXES[wanted] * (1 if own else 0.25), 1e-9)
