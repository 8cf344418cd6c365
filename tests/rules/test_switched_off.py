"""A rule that is switched off, or made milder, takes nothing along that another would tell."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from process import ROOT
from pxr import Sdf

from usdvol_lint.config import Config
from usdvol_lint.engine.engine import Engine
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import Catalog
from usdvol_lint.packs.examples import STAGE, cases, pages
from usdvol_lint.run.testing import write_example

EXAMPLES = {
    f"{page.code} {case.title}": case for page in pages(ROOT / "rules") for case in cases(page)
}

SILENT = (
    ("ARR001", "ARR018", "ARR001 Wrong 4"),
    ("ARR002", "ARR004", "ARR002 Wrong 4"),
    ("ARR003", "ARR004", "ARR003 Wrong 3"),
    ("ARR004", "ARR002", "ARR004 Wrong 3"),
    ("ARR004", "ARR003", "ARR004 Wrong 2"),
    ("ARR004", "ARR006", "ARR004 Wrong 4"),
    ("ARR004", "ARR015", "ARR015 Right 2"),
    ("ARR007", "ARR008", "ARR007 Wrong 6"),
    ("ARR007", "ARR009", "ARR007 Wrong 6"),
    ("ARR007", "SCH008", "SCH008 Right 3"),
    ("ARR002 ARR003 ARR004", "ARR025", "ARR025 Right 2"),
    ("ARR013", "ARR022", "ARR013 Wrong 1"),
    ("ARR013", "SCH017", "SCH017 Right 2"),
    ("AST002", "AST007", "AST007 Right 2"),
    ("AST006", "SCH016", "SCH016 Right 4"),
    ("AST008", "AST002", "AST008 Wrong 1"),
    ("AST009", "AST002", "AST009 Wrong 1"),
    ("AST014", "ARR001", "AST014 Wrong 3"),
    ("AST014", "ARR017", "AST014 Wrong 4"),
    ("AST014", "ARR021", "AST014 Wrong 9"),
    ("AST014", "AST001", "AST014 Wrong 1"),
    ("AST014", "AST017", "AST014 Wrong 7"),
    ("AST015", "AST002", "AST015 Wrong 2"),
    ("AST016", "ARR001", "AST016 Wrong 25"),
    ("AST016", "AST001", "AST016 Wrong 1"),
    ("AST017", "VOL014", "VOL014 Right 4"),
    ("GRD001", "AST006", "GRD001 Wrong 6"),
    ("PRT001", "PRT007", "PRT001 Wrong 3"),
    ("PRT003", "PRT007", "PRT007 Right 4"),
    ("PRT006", "PRT001", "PRT006 Wrong 1"),
    ("PRT006", "PRT002", "PRT006 Wrong 3"),
    ("PRT006", "PRT003", "PRT006 Wrong 3"),
    ("PRT006", "PRT004", "PRT006 Wrong 2"),
    ("PRT006", "PRT007", "PRT006 Wrong 1"),
    ("PRT007", "ARR021", "ARR021 Right 2"),
    ("PRT009", "PRT001", "PRT009 Wrong 1"),
    ("PRT009", "PRT002", "PRT009 Wrong 1"),
    ("PRT009", "PRT003", "PRT009 Wrong 1"),
    ("PRT009", "PRT007", "PRT009 Wrong 1"),
    ("PRT010", "PRT001", "PRT010 Wrong 1"),
    ("PRT010", "PRT002", "PRT010 Wrong 1"),
    ("PRT010", "PRT003", "PRT010 Wrong 1"),
    ("PRT010", "PRT007", "PRT010 Wrong 1"),
    ("SCH001", "LNT005", "SCH001 Wrong 3"),
    ("SCH004", "ARR001", "ARR001 Right 5"),
    ("SCH004", "ARR004", "SCH004 Wrong 5"),
    ("SCH004", "ARR015", "SCH004 Wrong 5"),
    ("SCH004", "ARR017", "ARR017 Right 5"),
    ("SCH004", "ARR020", "ARR020 Right 4"),
    ("SCH004", "ARR021", "ARR021 Right 2"),
    ("SCH004", "AST001", "SCH004 Wrong 1"),
    ("SCH004", "FLD001", "SCH004 Wrong 1"),
    ("SCH004", "FLD002", "SCH004 Wrong 1"),
    ("SCH004", "SCH007", "SCH004 Wrong 15"),
    ("SCH010", "SCH014", "SCH014 Right 5"),
    ("SCH012", "ARR001", "SCH012 Wrong 9"),
    ("SCH012", "AST006", "SCH012 Wrong 7"),
    ("SCH012", "FLD007", "SCH012 Wrong 8"),
    ("SCH012", "PRT001", "SCH012 Wrong 9"),
    ("SCH012", "PRT002", "SCH012 Wrong 9"),
    ("SCH012", "PRT003", "SCH012 Wrong 9"),
    ("SCH012", "PRT007", "SCH012 Wrong 9"),
    ("SCH012", "SCH010", "SCH012 Wrong 4"),
    ("SCH012", "SCH014", "SCH012 Wrong 3"),
    ("SCH012", "SCH016", "SCH012 Wrong 10"),
    ("SCH012", "VOL002", "SCH012 Wrong 3"),
    ("SCH012", "VOL010", "SCH012 Wrong 9"),
    ("STG008", "AST012", "STG008 Wrong 4"),
    ("STG005", "STG010", "STG010 Right 8"),
    ("STG010", "AST001", "STG010 Wrong 3"),
    ("VOL008", "STG005", "STG005 Right 8"),
    ("VOL013", "SCH017", "SCH017 Right 3"),
)
"""The codes that tell, one that is silent for it, and an example that shows it."""

UNKNOWN = """#usda 1.0
def Volume "cloud"
{
    float3[] extent = [(-4, -4, -4), (4, 4, 4)]
    rel field:density = <density>
    def OpenVDBAssetV2 "density"
    {
        asset filePath = @cloud.vdb@
    }
}
"""
NANOVDB = """#usda 1.0
def Volume "cloud"
{
    float3[] extent = [(-4, -4, -4), (4, 4, 4)]
    rel field:density = <density>
    def Field3DAsset "density"
    {
        asset filePath = @grids/nanovdb.vdb@
        token fieldName = "density"
        token fieldDataType = "float"
    }
}
"""
ABSOLUTE = """#usda 1.0
def Volume "cloud"
{
    float3[] extent = [(-4, -4, -4), (4, 4, 4)]
    rel field:density = <density>
    def OpenVDBAsset "density"
    {
        asset filePath = @/nowhere/cloud.vdb@
        token fieldName = "density"
        token fieldDataType = "float"
    }
}
"""

Codes = Callable[[str, Config], list[str]]


@pytest.fixture
def codes(catalog: Catalog, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Codes:
    """The codes found in the stage of the working directory under a configuration."""
    monkeypatch.chdir(tmp_path)

    def lint(stage: str, config: Config) -> list[str]:
        engine = Engine(catalog.rules, activate(config, catalog))
        return [finding.code for finding in engine.lint(stage).findings]

    return lint


@pytest.mark.parametrize(("tellers", "silent", "example"), SILENT)
def test_what_the_one_would_tell_the_other_tells(
    tellers: str, silent: str, example: str, codes: Codes, tmp_path: Path, assets: Path
) -> None:
    write_example(EXAMPLES[example], tmp_path, assets)
    assert silent not in codes(STAGE, Config())
    assert silent in codes(STAGE, Config(ignore=tuple(tellers.split())))


def test_a_rule_made_milder_tells_no_more_for_others(
    codes: Codes, tmp_path: Path, assets: Path
) -> None:
    """No severity of one rule takes an error of another away."""
    write_example(EXAMPLES["AST009 Wrong 1"], tmp_path, assets)
    assert codes(STAGE, Config(severity={"AST009": "error"})) == ["AST009"]
    assert sorted(codes(STAGE, Config(severity={"AST009": "info"}))) == ["AST002", "AST009"]
    assert codes(STAGE, Config(severity={"AST002": "info"})) == ["AST009"]


def test_format_that_the_extension_shows(codes: Codes, tmp_path: Path, assets: Path) -> None:
    shutil.copytree(assets / "grids", tmp_path / "grids")
    (tmp_path / "stage.usda").write_text(NANOVDB, encoding="utf-8")
    assert codes("stage.usda", Config()) == ["AST006"]
    assert codes("stage.usda", Config(ignore=("AST006",))) == ["GRD001"]


def test_version_of_a_type(codes: Codes, tmp_path: Path) -> None:
    (tmp_path / "stage.usda").write_text(UNKNOWN, encoding="utf-8")
    assert codes("stage.usda", Config()) == ["LNT005"]
    assert codes("stage.usda", Config(ignore=("VOL002",))) == ["LNT005"]
    assert codes("stage.usda", Config(ignore=("SCH001",))) == ["LNT005"]


def test_apis_on_an_unknown_type(codes: Codes, tmp_path: Path) -> None:
    for name, teller in (("ParticleFeild", "SCH001"), ("ParticleFieldV2", "SCH010")):
        text = (
            f'#usda 1.0\ndef {name} "p" (apiSchemas = ["ParticleFieldPositionAttributeAPI"])\n'
            "{\n    point3f[] positions = [(0, 0, 0)]\n}\n"
        )
        (tmp_path / f"{name}.usda").write_text(text, encoding="utf-8")
        assert "LNT005" in codes(f"{name}.usda", Config(ignore=(teller,)))


def test_absolute_path_in_a_package(codes: Codes, tmp_path: Path) -> None:
    (tmp_path / "cloud.usda").write_text(ABSOLUTE, encoding="utf-8")
    with Sdf.ZipFileWriter.CreateNew("cloud.usdz") as package:
        package.AddFile("cloud.usda")
    assert codes("cloud.usdz", Config()) == ["AST015"]
    assert codes("cloud.usdz", Config(ignore=("AST015",))) == ["AST002"]
    assert codes("cloud.usdz", Config(ignore=("AST015", "AST002"))) == ["AST007"]
    assert codes("cloud.usdz", Config(ignore=("AST002",))) == ["AST015"]
