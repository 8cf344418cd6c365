"""What all tests share: an engine with every rule, and stages written to a temporary folder."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

from usdvol_lint.config import Config
from usdvol_lint.engine.engine import Engine
from usdvol_lint.model import StageReport
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import Catalog, load

ROOT = Path(__file__).parent.parent

# A busy machine fails no test.
settings.register_profile("untimed", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("untimed")


@pytest.fixture(scope="session")
def catalog() -> Catalog:
    return load()


@pytest.fixture(scope="session")
def engine(catalog: Catalog) -> Engine:
    """Every rule, those that are off by default too."""
    return Engine(catalog.rules, activate(Config(select=("ALL",)), catalog))


@pytest.fixture(scope="session")
def assets(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of rules/assets, which examples may link to."""
    return Path(shutil.copytree(ROOT / "rules" / "assets", tmp_path_factory.mktemp("copy") / "a"))


@pytest.fixture
def lint_text(
    engine: Engine, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Callable[[str], StageReport]:
    """Lints a stage given as text, from a folder of its own that is the working directory."""
    monkeypatch.chdir(tmp_path)

    def lint(text: str, name: str = "stage.usda") -> StageReport:
        (tmp_path / name).write_text(text, encoding="utf-8")
        return engine.lint(name)

    return lint
