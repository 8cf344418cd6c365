"""What is found of a prim does not depend on which prims are looked at together with it."""

from __future__ import annotations

import gc
import shutil
from collections import Counter
from collections.abc import Callable
from itertools import cycle, islice
from pathlib import Path
from typing import Any

import pytest
from process import ROOT
from pxr import Sdf, Tf

import usdvol_lint.facts.prims.tables as tables
import usdvol_lint.facts.usd.batches as batches
from usdvol_lint.config import Config
from usdvol_lint.engine import walk
from usdvol_lint.engine.engine import Engine
from usdvol_lint.model import Finding, StageReport
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import Catalog

PRIMS = 60
EXTENT = "float3[] extent = [(-9, -9, -9), (9, 9, 9)]"
TYPE = 'token fieldDataType = "float"'
VOLUMES = (
    EXTENT,
    "float3[] extent = [(0, 0, 0), (0.1, 0.1, 0.1)]",
    f"{EXTENT}\n custom rel link = <../density>",
    f"{EXTENT}\n custom int studio:id = 3\n rel field:other = <density>",
    "float3[] extent.timeSamples = {1: [(-9, -9, -9), (9, 9, 9)], 2: [(0, 0, 0)]}",
    f'{EXTENT}\n def Mesh "m"\n {{\n }}',
    "double3 xformOp:translate = (0, 5, 0)\n"
    f'uniform token[] xformOpOrder = ["xformOp:translate"]\n{EXTENT}',
)
FIELDS = (
    'asset filePath = @./cloud.vdb@\n token fieldName = "density"\n string fieldDataType = "x"',
    f'asset filePath = @./cloud.vdb@\n string fieldName = "density"\n {TYPE}',
    f'asset filePath = @./cloud.vdb@\ntoken fieldName = "density"\ndouble fieldIndex = 1\n{TYPE}',
    f'asset filePath = @./cloud.vdb@\ntoken fieldName = "density"\nint fieldIndex = 1\n{TYPE}',
    f'asset filePath = @./cloud.vdb@\n token fieldName = "density"\n {TYPE}',
    f'asset filePath = @./gone.vdb@\n token fieldName = "density"\n {TYPE}',
    f'asset filePath = @./cloud.vdb@\n token fieldName = "heat"\n {TYPE}',
    "asset filePath.timeSamples = {1: @./cloud.vdb@, 2: @./gone.2.vdb@}",
    'string filePath = "cloud.vdb"\n token fieldClass = "fog"',
    "asset filePath = @./cloud.vdb@\n double3 xformOp:translate = (9, 0, 0)\n"
    'uniform token[] xformOpOrder = ["xformOp:translate"]',
)
TARGETS = ("density", *["density"] * 3, "densty", "density.filePath", "../common")


def stage() -> str:
    common = f'def OpenVDBAsset "common"\n{{\n{FIELDS[0]}\n}}\n'
    columns = zip(cycle(VOLUMES), cycle(FIELDS), cycle(TARGETS), strict=False)
    common += f'def OpenVDBAsset "unused"\n{{\n{FIELDS[0]}\n}}\ndef Volume "bare"\n{{\n}}\n'
    return f"#usda 1.0\n{common}" + "".join(
        f'def Volume "v{number}"\n{{\n{volume}\nrel field:density = <{target}>\n'
        f'def OpenVDBAsset "density"\n{{\n{field}\n}}\n}}\n'
        for number, (volume, field, target) in enumerate(islice(columns, PRIMS))
    )


@pytest.fixture
def lint(lint_text: Callable[[str], StageReport], tmp_path: Path) -> Callable[[], StageReport]:
    shutil.copy(ROOT / "rules" / "assets" / "cloud.vdb", tmp_path)
    return lambda: lint_text(stage())


def test_how_many_are_looked_at_together(
    lint: Callable[[], StageReport], monkeypatch: pytest.MonkeyPatch
) -> None:
    whole = lint()
    codes = Counter(finding.code for finding in whole.findings)
    assert {
        "VOL001",
        "VOL005",
        "VOL013",
        "SCH003",
        "GRD004",
        "AST002",
        "GRD003",
        "SCH005",
    } <= codes.keys()
    for prims, batch in ((1, 1), (2, 3), (7, 64)):
        monkeypatch.setattr(tables, "_CHUNK_SIZE", prims)
        monkeypatch.setattr(walk, "_BATCH", batch)
        assert lint().findings == whole.findings


def test_a_prim_that_can_not_be_read_keeps_no_other_back(
    lint: Callable[[], StageReport], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nor what is said of the stage as a whole; but it is said, whatever rules there are."""
    whole = besides(lint(), "/v30")
    assert "VOL012" in {finding.code for finding in whole}
    for question in ("get_value", "get_property_names"):
        with monkeypatch.context() as patch:
            patch.setattr(batches, question, failing(getattr(batches, question), "/v30/density"))
            report = lint()
        failed = {each.site.prim for each in report.findings if each.code == "LNT001"}
        assert failed <= {"/v30", "/v30/density"}  # what the Volume is held against is there too
        assert "/v30/density" in failed
        # The traceback is that of the prim alone, however many were tried together.
        details = [each.detail.count("Traceback") for each in report.findings if each.detail]
        assert details == [1] * len(details)
        assert besides(report, "/v30") == whole


@pytest.mark.parametrize(
    ("code", "question", "is_said"),
    [
        ("VOL012", "get_relationship", False),
        ("SCH007", "get_value", True),
        ("STG001", "get_prim_stack", True),
    ],
)
def test_what_is_left_out_of_a_stage_as_a_whole_is_said_under_any_rules(
    code: str,
    question: str,
    is_said: bool,
    catalog: Catalog,
    lint: Callable[[], StageReport],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The Volume that can't be read may have targeted any of the fields."""
    expected = [each for each in lint().findings if each.code == code]
    assert expected or code == "STG001"
    engine = Engine(catalog.rules, activate(Config(select=(code, "LNT")), catalog))
    for asked in (question, "get_property_names"):
        with monkeypatch.context() as patch:
            patch.setattr(batches, asked, failing(getattr(batches, asked), "/v30"))
            findings = engine.lint("stage.usda").findings
        assert [each for each in findings if each.code == code] == (expected if is_said else [])
        unread = [each.site.prim for each in findings if each.code == "LNT001"]
        assert "/v30" in unread
        assert set(unread) <= {"/v30", "/v30/density"}


@pytest.mark.parametrize("question", ["get_property_names", "get_prim_stack", "get_value"])
def test_a_prim_that_can_not_be_read_keeps_no_layer_alive(
    question: str,
    lint: Callable[[], StageReport],
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
) -> None:
    """The traceback of what was raised holds frames, which hold the stage."""
    monkeypatch.setattr(batches, question, failing(getattr(batches, question), "/v30"))
    gc.disable()
    try:
        assert "LNT001" in {finding.code for finding in lint().findings}
        assert Sdf.Layer.Find(str(tmp_path.resolve() / "stage.usda")) is None
    finally:
        gc.enable()


def besides(report: StageReport, prim: str) -> list[Finding]:
    """What a report says, but for a prim and those below it."""
    return [each for each in report.findings if not (each.site.prim or "").startswith(prim)]


def failing(ask: Callable[..., Any], path: str) -> Callable[..., Any]:
    """A question to USD that raises for one prim and its attributes."""

    def ask_or_fail(asked: Any, *name: str) -> Any:
        if str(asked.GetPath()).startswith(path):
            Tf.RaiseRuntimeError("corrupt")
        return ask(asked, *name)

    return ask_or_fail
