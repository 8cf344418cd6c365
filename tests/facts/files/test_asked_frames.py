"""The production's range of frames, in place of that of the stage."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from fieldtexts import field, said, sampled, write

from usdvol_lint.config import Config, Depth
from usdvol_lint.engine.engine import Engine
from usdvol_lint.model import StageReport
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import Catalog

OWN = "(\n    startTimeCode = 1\n    endTimeCode = 3\n)"
Lint = Callable[..., StageReport]


@pytest.fixture
def lint(catalog: Catalog, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Lint:
    monkeypatch.chdir(tmp_path)
    write(tmp_path, *(f"cloud.{number:04}.vdb" for number in range(1, 8)))

    def call(text: str, frames: tuple[float, float] | None) -> StageReport:
        (tmp_path / "stage.usda").write_text(text, encoding="utf-8")
        active = activate(Config(select=("AST012", "AST017")), catalog)
        return Engine(catalog.rules, active, Depth(frames=frames)).lint("stage.usda")

    return call


@pytest.mark.parametrize("header", ["", OWN])
def test_samples_have_to_cover_it(header: str, lint: Lint) -> None:
    text = sampled(((n, f"./cloud.{n:04}.vdb") for n in range(1, 4)), header)
    assert said(lint(text, None), "AST012") == []
    assert said(lint(text, (1.0, 3.0)), "AST012") == []
    report = lint(text, (1.0, 5.0))
    message = (
        "the samples are at 1-3, the production's range is 1-5: the last file is held from 3 on"
    )
    assert [found[2:] for found in said(report, "AST012")] == [
        (message, "write the frames that are missing")
    ]
    (finding,) = report.findings
    assert (finding.severity.label, finding.source.path) == ("warning", "/density")


def test_one_file_of_a_sequence_does_not_fill_it(lint: Lint) -> None:
    text = field("asset filePath = @./cloud.0001.vdb@")
    assert said(lint(text, None), "AST017") == []
    (found,) = said(lint(text, (1.0, 7.0)), "AST017")
    assert found[2].endswith("though the files 1-7 lie beside it and the production's range is 1-7")
