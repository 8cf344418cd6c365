"""A file that is missing for a cause that its path shows is one finding."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
import vdbwriter
from process import ASSETS

from usdvol_lint.facts.files.disk import Disk
from usdvol_lint.facts.files.folders import Listing
from usdvol_lint.model import StageReport

Lint = Callable[..., StageReport]

STAGE = '#usda 1.0\ndef OpenVDBAsset "a"\n{\n    asset filePath = @./cloud.vdb@\n}\n'


def test_another_case_is_a_warning_where_the_file_is_found(
    lint_text: Lint, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "cloud.vdb").write_bytes(b"1")
    monkeypatch.setattr(Disk, "listing", lambda self, folder: Listing(("Cloud.vdb",)))
    monkeypatch.setattr(Disk, "ignores_case", lambda self, path: True)
    found = {finding.code: finding for finding in lint_text(STAGE).findings}
    assert found["AST009"].severity.label == "warning"
    assert "so no file is found" not in found["AST009"].message


def test_an_openvdb_file_with_nanovdb_in_its_name(lint_text: Lint, tmp_path: Path) -> None:
    shutil.copy(ASSETS / "cloud.vdb", tmp_path / "cloud.nvdb")
    found = lint_text(STAGE.replace("cloud.vdb", "cloud.nvdb")).findings
    [finding] = [each for each in found if each.code in ("AST006", "GRD001")]
    assert (
        finding.message
        == "'./cloud.nvdb' does not end in '.vdb', as the file of an OpenVDBAsset does"
    )
    assert finding.suggestion == "end its name in '.vdb'"


def test_a_broken_file_of_the_other_format_is_of_the_other_format(
    lint_text: Lint, tmp_path: Path
) -> None:
    broken = vdbwriter.Grid("heat", offsets=lambda grid, block, end: (block, grid, end))
    (tmp_path / "cloud.vdb").write_bytes(vdbwriter.vdb(vdbwriter.Grid(), broken))
    found = lint_text(STAGE.replace("OpenVDBAsset", "Field3DAsset")).findings
    assert [each.code for each in found if each.code in ("AST006", "GRD001", "FLD007")] == [
        "AST006"
    ]


def test_fields_of_two_types_that_name_one_file_are_told_apart(
    lint_text: Lint, tmp_path: Path
) -> None:
    shutil.copy(ASSETS / "cloud.vdb", tmp_path / "cloud.f3d")
    fields = "".join(
        f'def {kind} "{name}"\n{{\n    asset filePath = @./cloud.f3d@\n}}\n'
        for name, kind in (("a", "OpenVDBAsset"), ("b", "Field3DAsset"), ("c", "Field3DAsset"))
    )
    found = lint_text(f"#usda 1.0\n{fields}").findings
    assert [
        (each.code, each.site.prim, each.fold)
        for each in found
        if each.code in ("AST006", "GRD001")
    ] == [("AST006", "/a", "/a OpenVDBAsset"), ("GRD001", "/b", "/a"), ("GRD001", "/c", "/a")]
