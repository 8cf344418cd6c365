"""Nothing of a stage outlives its lint: facts are free of reference cycles.

Worker processes have the garbage collector off while they lint.
A layer that a cycle keeps alive stays in USD's registry, and whoever opens its path next is served
what it held.
"""

from __future__ import annotations

import gc
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from process import ROOT, ROUGH, volume
from pxr import Sdf

from usdvol_lint.config import Config, Depth
from usdvol_lint.engine.engine import Engine
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import Catalog, load
from usdvol_lint.packs.examples import STAGE, Case, cases, pages
from usdvol_lint.run.testing import write_example

EXAMPLES = ROOT / "docs" / "examples"
STAGES = sorted(path.relative_to(EXAMPLES).as_posix() for path in EXAMPLES.rglob("*.usd*"))
RULES = ROOT / "rules"
FIRST = [case for page in pages(RULES) for case in cases(page) if case.title.endswith(" 1")]


@pytest.fixture(scope="module")
def engines(catalog: Catalog) -> dict[str, Engine]:
    """By which variants they look at; all of them are those that are selected, and more."""
    active = activate(Config(select=("ALL",)), catalog)
    return {
        variants: Engine(catalog.rules, active, Depth(selections=limit, statistics=True))
        for variants, limit in (("selected", 0), ("all", 100))
    }


@contextmanager
def no_collector() -> Iterator[None]:
    gc.disable()
    try:
        yield
    finally:
        gc.enable()


def kept_of(folder: Path) -> list[str]:
    """The layers in a folder that USD still holds."""
    layers = (Path(layer.realPath) for layer in Sdf.Layer.GetLoadedLayers() if layer.realPath)
    return sorted(
        path.relative_to(folder).as_posix() for path in layers if path.is_relative_to(folder)
    )


def test_a_layer_that_is_held_is_seen(tmp_path: Path) -> None:
    (tmp_path / STAGE).write_text("#usda 1.0\n")
    layer = Sdf.Layer.FindOrOpen(str(tmp_path / STAGE))
    assert kept_of(tmp_path.resolve()) == [STAGE]
    del layer
    assert kept_of(tmp_path.resolve()) == []


@pytest.mark.parametrize("variants", ["selected", "all"])
@pytest.mark.parametrize("stage", STAGES)
def test_examples_of_the_documentation(
    stage: str, variants: str, engines: dict[str, Engine], tmp_path: Path
) -> None:
    folder = Path(shutil.copytree(EXAMPLES, tmp_path / "examples")).resolve()
    with no_collector():
        report = engines[variants].lint(str(folder / stage))
        assert (report.status, kept_of(folder)) == ("checked", [])


@pytest.mark.parametrize("case", FIRST, ids=lambda case: f"{case.page.code}-{case.example.heading}")
def test_examples_of_pages(
    case: Case, engines: dict[str, Engine], assets: Path, tmp_path: Path
) -> None:
    folder = tmp_path.resolve()
    write_example(case, folder, assets)
    with no_collector():
        engines["all"].lint(str(folder / STAGE))
        assert kept_of(folder) == []


@pytest.mark.parametrize(("name", "code"), [("raise", "LNT002"), ("damaged", "LNT001")])
def test_rules_that_fail(name: str, code: str, tmp_path: Path) -> None:
    """A traceback holds frames, which hold the stage: only its text is kept."""
    rules = load([str(ROUGH)])
    engine = Engine(rules.rules, activate(Config(select=("RGH",)), rules))
    folder = tmp_path.resolve()
    (folder / STAGE).write_text(volume(name), encoding="utf-8")
    with no_collector():
        (finding,) = engine.lint(str(folder / STAGE)).findings
        assert (finding.code, kept_of(folder)) == (code, [])
    assert "behaves.py" in (finding.detail or "")
