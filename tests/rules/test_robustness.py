"""No rule fails, whatever a stage holds: next to nothing, garbage, strange relationships."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from pxr import Sdf, Usd, Vt

from usdvol_lint import schema
from usdvol_lint.config import Config
from usdvol_lint.engine.engine import Engine
from usdvol_lint.model import Finding
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import Catalog


@pytest.fixture(scope="module")
def everything(catalog: Catalog) -> Engine:
    return Engine(catalog.rules, activate(Config(select=("ALL",)), catalog))


def failures(findings: tuple[Finding, ...]) -> list[str]:
    """What the rules themselves did wrong: a stage that makes USD fail is no such thing."""
    return [
        f"{finding.site.prim}: {finding.message}\n{finding.detail}"
        for finding in findings
        if finding.code == "LNT002"
    ]


TYPES = sorted({*schema.TYPE_BASES, "Xform", "Points", "Nonsense", ""})


def bare(type_name: str) -> str:
    apis = ", ".join(f'"{api}"' for api in schema.API_INCLUDES)
    return (
        "#usda 1.0\n"
        f'def {type_name} "bare"\n{{\n}}\n'
        f'def {type_name} "applied" (\n    prepend apiSchemas = [{apis}]\n)\n{{\n}}\n'
    )


@pytest.mark.parametrize(
    "text",
    ["#usda 1.0\n", *map(bare, TYPES)],
    ids=["empty", *(name or "untyped" for name in TYPES)],
)
def test_no_rule_fails_on_next_to_nothing(
    text: str, everything: Engine, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "stage.usda").write_text(text, encoding="utf-8")
    report = everything.lint("stage.usda")
    assert failures(report.findings) == []


GARBAGE: tuple[tuple[str, Any], ...] = (
    ("string", "text"),
    ("string", ""),
    ("token", "\N{SNOWMAN}"),
    ("token[]", Vt.TokenArray(["a", "b"])),
    ("bool", True),
    ("int", -7),
    ("int[]", Vt.IntArray()),
    ("int64", 2**62),
    ("double", float("nan")),
    ("float", float("inf")),
    ("half", -0.0),
    ("float[]", Vt.FloatArray([float("nan"), 1.0, float("-inf")])),
    ("float[]", Vt.FloatArray()),
    ("half[]", Vt.HalfArray(3)),
    ("float3", (float("nan"), 0, 1)),
    ("float3[]", Vt.Vec3fArray(3)),
    ("float3[]", Vt.Vec3fArray([(float("nan"), 0, 0)] * 2)),
    ("point3f[]", Vt.Vec3fArray(5)),
    ("point3d[]", Vt.Vec3dArray(2)),
    ("quatf[]", Vt.QuatfArray(2)),
    ("quath[]", Vt.QuathArray(1)),
    ("matrix4d", None),
    ("asset", Sdf.AssetPath("")),
    ("asset", Sdf.AssetPath("a.vdb")),
    ("asset", Sdf.AssetPath(".")),
    ("asset", Sdf.AssetPath("a.usdz[b.vdb]")),
    ("asset", Sdf.AssetPath("`${X`")),
    ("asset[]", Sdf.AssetPathArray([Sdf.AssetPath("a.vdb"), Sdf.AssetPath("")])),
    ("timecode", Sdf.TimeCode(3)),
)


def attributes(type_name: str) -> list[str]:
    """What rules may read of a prim of that type: what USD or we know of it, and a field."""
    known: set[str] = {name for names in schema.API_ATTRIBUTES.values() for name in names}
    known |= {"filePath", "fieldName", "fieldIndex", "fieldDataType", "fieldClass", "extent"}
    known |= {"vectorDataRoleHint", "projectionModeHint", "sortingModeHint", "field:density"}
    definition = Usd.SchemaRegistry().FindConcretePrimDefinition(type_name)
    if definition:
        known |= {
            name
            for name in definition.GetPropertyNames()
            if definition.GetSpecType(name) == Sdf.SpecTypeAttribute
        }
    return sorted(known)


@pytest.mark.parametrize("type_name", TYPES, ids=lambda name: name or "untyped")
def test_no_rule_fails_on_garbage(
    type_name: str, everything: Engine, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Every kind of value in every attribute: as the default, at a time, blocked, and together."""
    monkeypatch.chdir(tmp_path)
    layer = Sdf.Layer.CreateNew("stage.usda")
    for number, (value_type, value) in enumerate(GARBAGE):
        prim = Sdf.PrimSpec(layer, f"p{number}", Sdf.SpecifierDef, type_name)
        if number % 2:
            apis = Sdf.TokenListOp.Create(prependedItems=list(schema.API_INCLUDES))
            prim.SetInfo("apiSchemas", apis)
        for index, name in enumerate(attributes(type_name), start=number):
            spec = Sdf.AttributeSpec(prim, name, Sdf.ValueTypeNames.Find(value_type))
            given = spec.typeName.defaultValue if value is None else value
            if index % 3 != 1:
                spec.default = given
            if index % 3 != 0:
                layer.SetTimeSample(spec.path, -1.0, given)
                layer.SetTimeSample(spec.path, 2.5, Sdf.ValueBlock())
                layer.SetTimeSample(spec.path, 1e300, given)
            if index % 7 == 0:
                spec.default = Sdf.ValueBlock()
    layer.Save()
    report = everything.lint("stage.usda")
    assert failures(report.findings) == []
    assert report.stats["prims"] == len(GARBAGE)


RELATIONSHIPS = """
    rel field
    rel field:empty
    rel field:blocked = None
    rel field:gone = </gone>
    rel field:itself = </{name}>
    rel field:round = </{name}.field:round>
    rel field:one = </{name}.field:two>
    rel field:two = </{name}.field:one>
    rel field:all = [</gone>, </{name}/inner>, </{name}/inner.filePath>, </{name}/inner/deep>]
    rel field:a:b = </{name}/inner>
    rel field:c:b = <inner>
    double field:number = 3
    custom rel density = </{name}/inner>
    rel proxyPrim = </{name}/inner>
    rel material:binding = </{name}/inner>
"""


@pytest.mark.parametrize("type_name", TYPES, ids=lambda name: name or "untyped")
def test_no_rule_fails_on_strange_relationships(
    type_name: str, everything: Engine, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    inner = "".join(f'    def {type_name} "inner{n}"\n    {{\n    }}\n' for n in ("", 1))
    text = "#usda 1.0\n" + "".join(
        f'def {outer} "{name}"\n{{{RELATIONSHIPS.format(name=name)}{inner}}}\n'
        for outer, name in (("Volume", "volume"), (type_name, "other"))
    )
    (tmp_path / "stage.usda").write_text(text, encoding="utf-8")
    report = everything.lint("stage.usda")
    assert (report.status, failures(report.findings)) == ("checked", [])


CLIPPED = """
def Xform "A" (
    clips = {
        dictionary default = {
            double2[] active = [(0, 0), (1, inf), (2, nan)]
            asset[] assetPaths = [@./clip.usda@]
            asset manifestAssetPath = @./clip.usda@
            string primPath = "/A"
        }
    }
)
{
    def OpenVDBAsset "d"
    {
        asset filePath
    }
}
"""
UNMEASURED = """
def ParticleField3DGaussianSplat "S"
{
    point3f[] positions = [(nan, nan, nan)]
    float3[] scales = [(-0.1, -0.2, -0.1)]
    float[] opacities = [1]
}
"""


@pytest.mark.parametrize("text", [CLIPPED, UNMEASURED])
def test_numbers_that_are_not_finite(text: str, everything: Engine, tmp_path: Path) -> None:
    clip = 'over "A"\n{\nover "d"\n{\nasset filePath.timeSamples = {1: @./a.vdb@}\n}\n}\n'
    (tmp_path / "clip.usda").write_text(f"#usda 1.0\n{clip}", encoding="utf-8")
    stage = tmp_path / "stage.usda"
    stage.write_text(f"#usda 1.0\n{text}", encoding="utf-8")
    assert failures(everything.lint(str(stage)).findings) == []
