"""What tests of the engine share: a lint that composes variants, and stages of layers as text."""

from __future__ import annotations

from pathlib import Path

import pytest
from blamings import Open
from pxr import Usd
from varianttexts import LIMIT, RULES, Lint, write

from usdvol_lint.config import Config, Depth
from usdvol_lint.engine.engine import Engine
from usdvol_lint.model import StageReport
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import Catalog


@pytest.fixture
def lint(catalog: Catalog, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Lint:
    """Lints the first of the layers, with so many other selections composed at most."""
    monkeypatch.chdir(tmp_path)

    def call(selections: int = LIMIT, load: str = "all", **layers: str) -> StageReport:
        write(layers)
        active = activate(Config(select=RULES), catalog)
        engine = Engine(catalog.rules, active, Depth(load=load, selections=selections))
        report = engine.lint(f"{next(iter(layers))}.usda")
        assert report.status == "checked"
        return report

    return call


@pytest.fixture
def opened(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Open:
    monkeypatch.chdir(tmp_path)

    def call(**layers: str) -> Usd.Stage:
        for name, text in layers.items():
            Path(f"{name}.usda").write_text(f"#usda 1.0\n{text}", encoding="utf-8")
        return Usd.Stage.Open(f"{next(iter(layers))}.usda")

    return call
