"""What tests of Volumes share: a stage beside the files of the examples."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import pytest
from process import ASSETS
from volumetexts import Lint

from usdvol_lint.config import Config, Depth
from usdvol_lint.engine.engine import Engine
from usdvol_lint.model import Finding
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import Catalog


@pytest.fixture
def lint(catalog: Catalog, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Lint:
    """What is said of extents, of a stage that is given as text beside the examples' files."""
    monkeypatch.chdir(tmp_path)
    shutil.copytree(ASSETS, tmp_path, dirs_exist_ok=True)

    def run(text: str, code: str = "VOL013", content: str = "all", **options: Any) -> list[Finding]:
        Path("stage.usda").write_text("#usda 1.0\n" + text, encoding="utf-8")
        config = Config(select=(code,), options={code: options} if options else {})
        engine = Engine(catalog.rules, activate(config, catalog), Depth(content=content))
        return list(engine.lint("stage.usda").findings)

    return run
