"""A file that is missing for a cause that its path shows is one finding."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

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
