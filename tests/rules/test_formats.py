"""AST006 and GRD001 on files in the format of the other type of field: one finding each."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from usdvol_lint.config import Config, Depth
from usdvol_lint.engine.engine import Engine
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import Catalog

ROOT = Path(__file__).parents[2]
OPENVDB = ROOT / "rules/assets/cloud.vdb"
FIELD3D = ROOT / "tests/samples/f3d_ogawa.f3d"
NANOVDB = ROOT / "tests/samples/type_all_z.nvdb"
NOTE = ROOT / "rules/assets/grids/text.vdb"
STAGE = """#usda 1.0
def Volume "cloud"
{{
    float3[] extent = [(-9, -9, -9), (99, 99, 99)]
    rel field:density = </cloud/density>

    def {type} "density"
    {{
        asset filePath = @./{name}@
        token fieldName = "{grid}"
    }}
}}
"""


@pytest.mark.parametrize(
    ("type_name", "name", "data", "found"),
    [
        ("OpenVDBAsset", "cloud.vdb", OPENVDB, set()),
        ("Field3DAsset", "cloud.f3d", FIELD3D, set()),
        ("OpenVDBAsset", "cloud.bin", OPENVDB, {("AST006", "warning")}),
        ("OpenVDBAsset", "cloud.f3d", OPENVDB, {("AST006", "warning")}),
        ("OpenVDBAsset", "cloud.f3d", FIELD3D, {("AST006", "error")}),
        ("OpenVDBAsset", "cloud.bin", FIELD3D, {("AST006", "error")}),
        ("OpenVDBAsset", "cloud.vdb", FIELD3D, {("GRD001", "error")}),
        ("Field3DAsset", "cloud.bin", FIELD3D, {("AST006", "warning")}),
        ("Field3DAsset", "cloud.vdb", OPENVDB, {("AST006", "error")}),
        ("Field3DAsset", "cloud.bin", OPENVDB, {("AST006", "error")}),
        ("Field3DAsset", "cloud.f3d", OPENVDB, {("GRD001", "error")}),
        ("OpenVDBAsset", "cloud.bin", NANOVDB, {("AST006", "warning")}),
        ("OpenVDBAsset", "cloud.nvdb", NANOVDB, {("AST006", "warning")}),
        ("OpenVDBAsset", "cloud.vdb", NANOVDB, {("GRD001", "warning")}),
        ("Field3DAsset", "cloud.f3d", NANOVDB, {("GRD001", "error")}),
        ("Field3DAsset", "cloud.nvdb", NANOVDB, {("AST006", "error")}),
        ("OpenVDBAsset", "cloud.bin", NOTE, {("GRD001", "error")}),
        ("OpenVDBAsset", "cloud.vdb", NOTE, {("GRD001", "error")}),
    ],
)
def test_the_format_of_the_other_type(
    type_name: str,
    name: str,
    data: Path,
    found: set[tuple[str, str]],
    engine: Engine,
    tmp_path: Path,
) -> None:
    stage = _stage(tmp_path, type_name, name, data)
    said = [(each.code, each.severity.label) for each in engine.lint(stage).findings]
    assert sorted(each for each in said if each[1] != "info") == sorted(found)


def test_one_extension_says_so_and_the_other_does_not(engine: Engine, tmp_path: Path) -> None:
    """The same content, by the extension of the wanted format and by one that says nothing."""
    stage = Path(_stage(tmp_path, "Field3DAsset", "cloud.bin", OPENVDB))
    shutil.copy(OPENVDB, tmp_path / "cloud.f3d")
    text = stage.read_text(encoding="utf-8")
    samples = "filePath.timeSamples = { 1: @./cloud.bin@, 2: @./cloud.f3d@ }"
    stage.write_text(text.replace("filePath = @./cloud.bin@", samples), encoding="utf-8")
    found = engine.lint(str(stage)).findings
    errors = [(each.code, each.site.times) for each in found if each.severity.label == "error"]
    assert errors == [("AST006", (1,)), ("GRD001", (2,))]


def test_a_file_that_is_not_looked_into_has_its_extension_alone(
    catalog: Catalog, tmp_path: Path
) -> None:
    stage = _stage(tmp_path, "Field3DAsset", "cloud.vdb", OPENVDB)
    active = activate(Config(select=("AST006",)), catalog)
    found = Engine(catalog.rules, active, Depth(content="off")).lint(stage).findings
    assert [(each.code, each.severity.label) for each in found] == [("AST006", "warning")]


def _stage(folder: Path, type_name: str, name: str, data: Path) -> str:
    shutil.copy(data, folder / name)
    grid = {OPENVDB: "density", FIELD3D: "temperature"}.get(data, "f")
    stage = folder / "stage.usda"
    stage.write_text(STAGE.format(type=type_name, name=name, grid=grid), encoding="utf-8")
    return str(stage)
