"""What tests of suppressions share: a lint of layers that are given as text."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, TypeAlias

import pytest
from process import Ran

from usdvol_lint.command import cli
from usdvol_lint.config import Config, Depth
from usdvol_lint.engine.engine import Engine
from usdvol_lint.model import Finding
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import Catalog
from usdvol_lint.suppressions import InStages

RULES = ("AST002", "AST010", "FLD002", "STG007", "LNT")
Lint: TypeAlias = Callable[..., tuple[Finding, ...]]


@pytest.fixture
def lint(catalog: Catalog, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Lint:
    """The findings on the first of some layers, of RULES."""
    monkeypatch.chdir(tmp_path)

    def call(layers: Mapping[str, str], selections: int = 0, **asked: Any) -> tuple[Finding, ...]:
        for name, text in layers.items():
            Path(name).write_text(f"#usda 1.0\n{text}", encoding="utf-8")
        active = activate(Config(select=RULES), catalog)
        depth = Depth(selections=selections)
        engine = Engine(catalog.rules, active, depth, suppressions=InStages(**asked))
        return engine.lint(next(iter(layers))).findings

    return call


@pytest.fixture
def tool(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> Callable[..., Ran]:
    """The command in this process, for all that starts no other."""
    monkeypatch.chdir(tmp_path)
    return lambda *arguments: Ran(cli.main(list(arguments)), *capfd.readouterr())
