"""What is told of a run over several stages, without starting one."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pytest
from identities import Find, finder
from partlayers import Files, Judge, told, write

from usdvol_lint.config import Config
from usdvol_lint.engine.engine import Engine
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import Catalog
from usdvol_lint.run.parts import completed_by


@pytest.fixture
def judge(catalog: Catalog, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Judge:
    """What is told of a run over these layers: file, code, level and place of each finding."""
    monkeypatch.chdir(tmp_path)

    def call(layers: Files, names: Sequence[str] = ()) -> list[str]:
        write(tmp_path, layers)
        engine = Engine(catalog.rules, activate(Config(), catalog))
        stages = [engine.lint(f"{name}.usda") for name in names or sorted(layers)]
        return told(stages, completed_by(stages))

    return call


@pytest.fixture
def find(catalog: Catalog, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Find:
    """The causes of a run over stages below a temporary folder, which is the root too."""
    monkeypatch.chdir(tmp_path)
    return finder(catalog, tmp_path)
