"""What findings about schemas, layers and extents say and advise in each of their cases."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from process import ROOT

from usdvol_lint.config import Config, Depth
from usdvol_lint.engine.engine import Engine
from usdvol_lint.model import StageReport
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import Catalog

Lint = Callable[..., StageReport]
DEGREE = "int radiance:sphericalHarmonicsDegree"
POSITIONED = 'prepend apiSchemas = ["ParticleFieldPositionAttributeAPI"]'
LAYERS = {
    "empty": "",
    "lib": 'def Xform "rocks"\n{\n    def Mesh "one"\n    {\n    }\n}\n'
    'def "lost" (references = @./gone.usda@)\n{\n}\n'
    'def "cut" (references = </rocks> (scale = 0))\n{\n}\n',
    "many": "".join(f'def "{name}"\n{{\n}}\n' for name in "abcd"),
}


def cloud(extent: str = "(0, 0, 0), (1, 1, 1)", field: str = "", below: str = "") -> str:
    return f"""
def Volume "cloud"
{{
    float3[] extent = [{extent}]
    rel field:density = </cloud/density>
    def OpenVDBAsset "density"
    {{
        asset filePath = @./cloud.vdb@
        token fieldName = "density"
        token fieldDataType = "float"
        {field}
    }}
    {below}
}}
"""


def prims(*arcs: str) -> str:
    """Prims called a, b and so on, with what is given in their metadata."""
    return "".join(f'def "{"abcd"[place]}" ({arc})\n{{\n}}\n' for place, arc in enumerate(arcs))


def splats(line: str) -> str:
    return f'def ParticleField3DGaussianSplat "splats"\n{{\n    {line}\n}}\n'


@pytest.mark.parametrize(
    ("code", "text", "message", "advice"),
    [
        ("SCH003", cloud().replace("float3[]", "double3[]"), "declares 'float3[] extent'", ""),
        (
            "SCH003",
            cloud().replace("float3[]", "vector3f[]"),
            "declares 'float3[] extent': the same values in another role",
            "",
        ),
        (
            "SCH005",
            cloud(field='token fieldClass = "fogvolume"'),
            "allows no fieldClass 'fogvolume'",
            "did you mean 'fogVolume'?",
        ),
        (
            "SCH005",
            cloud(field='token fieldClass = "smoke"'),
            "allows no fieldClass 'smoke'",
            "use one of 'levelSet', 'fogVolume', ",
        ),
        ("SCH006", splats(f"{DEGREE}.timeSamples = {{ 1: 0 }}"), "but has a time sample", ""),
        ("SCH006", splats(f"{DEGREE}.timeSamples = {{ 1: 0, 2: 0 }}"), "has 2 time samples", ""),
        ("SCH008", cloud("(0, 0, 0)"), "extent has 1 element, not two", ""),
        ("SCH008", cloud("(0, 0, 0), (1, 1, 1), (2, 2, 2)"), "extent has 3 elements, not two", ""),
        ("SCH008", cloud("(0, 0, 0), (1, nan, 1)"), "is not finite: (0.0, 0.0, 0.0), (1.0, n", ""),
        ("SCH008", cloud("(0, 5, 0), (1, 1, 1)"), "has a minimum above its maximum: (0.0, ", ""),
        ("SCH009", cloud(below='def Mesh "m"\n{\n}'), "Mesh below Volume </cloud>, which", ""),
        (
            "SCH009",
            cloud(below='def "set" (references = @./lib.usda@</rocks>; instanceable = true) {}'),
            "an instance, which holds Mesh </cloud/set/one>, below Volume </cloud>, which",
            "",
        ),
        ("SCH010", prims(POSITIONED), "'ParticleFieldPositionAttributeAPI' on a prim without", ""),
        (
            "SCH010",
            prims(POSITIONED).replace("def", "def Xform"),
            "'ParticleFieldPositionAttributeAPI' on 'Xform'",
            "",
        ),
        ("STG001", prims("references = @./libs.usda@"), "does not exist; ", "mean './lib.usda'?"),
        (
            "STG001",
            prims(*["references = @./lib.usda@</lost>"] * 2),
            "'./gone.usda' does not exist; what it holds was not checked (on 2 prims)",
            "",
        ),
        ("STG002", prims("references = @./lib.usda@</lost> (scale = 0)"), "invalid reference", ""),
        ("STG002", prims(*["references = @./lib.usda@</cut>"] * 2), " (on 2 prims)", ""),
        ("STG004", prims("references = </nope>"), "is no prim </nope> in this layer; what it", ""),
        (
            "STG004",
            prims("references = @./lib.usda@</rokcs/one>"),
            "there is no prim </rokcs/one> in './lib.usda'",
            "did you mean </rocks/one>?",
        ),
        ("STG004", prims("references = </nope>", "references = </a>"), " (on 2 prims)", ""),
        ("STG004", prims("references = @./empty.usda@"), "'./empty.usda' has no defaultPrim", ""),
        (
            "STG004",
            prims("payload = @./lib.usda@"),
            "the payload names no prim and brings nothing: './lib.usda' has no defaultPrim",
            "name the prim, one of </rocks>, </lost>, </cut>, or write a defaultPrim into",
        ),
        (
            "STG004",
            prims("references = @./many.usda@"),
            "has no defaultPrim",
            "one of </a>, </b>, </c>, …, or",
        ),
        ("STG003", "", "no prims at all in this layer", ""),
        ("STG003", "(subLayers = [@./empty.usda@])", "in this layer, nor in its sublayers", ""),
        (
            "VOL013",
            cloud("(0, 0, 0), (0.1, 0.1, 0.1)"),
            "may be cut off where it reaches out of the extent, by 0.5",
            "",
        ),
        (
            "VOL013",
            cloud("(0.2, 0.2, 0.2), (0.6, 0.6, 0.6)"),
            "the extent encloses the voxel centres of the grid",
            "",
        ),
        (
            "VOL013",
            cloud(", ".join(f"({n}, {n}, {n})" for n in ("3.40282347e38", "-3.40282347e38"))),
            "the extent is the empty range, and the grid",
            "",
        ),
    ],
)
def test_stages(
    code: str, text: str, message: str, advice: str, lint_text: Lint, tmp_path: Path
) -> None:
    shutil.copy(ROOT / "rules" / "assets" / "cloud.vdb", tmp_path)
    for name, content in LAYERS.items():
        (tmp_path / f"{name}.usda").write_text(f"#usda 1.0\n{content}", encoding="utf-8")
    text = text.replace("; instanceable", "\n instanceable")
    report = lint_text(f"#usda 1.0\n{text}")
    [finding] = [finding for finding in report.findings if finding.code == code]
    assert message in finding.message
    assert advice in (finding.suggestion or "")
    for further in (" in another role", " (on ", ", nor in its sublayers", ": (0"):
        assert (further in finding.message) == (further in message)


@pytest.mark.parametrize(
    ("count", "words"),
    [
        (1, "1 payload not loaded; what is below was not checked: /a"),
        (3, "3 payloads not loaded; what is below was not checked: /a, /b, /c"),
        (4, "4 payloads not loaded; what is below was not checked: /a, /b, /c, …"),
    ],
)
def test_payloads_that_are_not_loaded(
    count: int, words: str, catalog: Catalog, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("lib.usda").write_text(f"#usda 1.0\n{LAYERS['lib']}", encoding="utf-8")
    text = "#usda 1.0\n" + prims(*["payload = @./lib.usda@</rocks>"] * count)
    Path("stage.usda").write_text(text, encoding="utf-8")
    linter = Engine(catalog.rules, activate(Config(), catalog), Depth(load="none"))
    messages = [finding.message for finding in linter.lint("stage.usda").findings]
    assert words in messages
