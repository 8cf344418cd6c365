"""What is told of a run over several stages, without starting one."""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from pathlib import Path

import pytest
import vdbwriter
from identities import Find, finder
from partlayers import Files, Judge, told, write
from process import ASSETS

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


@pytest.fixture
def shots(tmp_path: Path) -> Path:
    """A folder for shots beside one with the files of assets."""
    assets = Path(shutil.copytree(ASSETS, tmp_path / "assets"))
    said = {"class": vdbwriter.string("fog volume"), **vdbwriter.bounds((0, 0, 0), (1, 1, 1))}
    kinds = {"density": "Tree_float_5_4_3", "velocity": "Tree_vec3s_5_4_3"}
    grids = [
        vdbwriter.Grid(name, kind, metadata={**said, "name": vdbwriter.string(name)})
        for name, kind in kinds.items()
    ]
    (assets / "two_grids.vdb").write_bytes(vdbwriter.vdb(*grids))
    return tmp_path / "shots"
