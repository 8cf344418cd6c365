"""The layers that stages name: each that is missing is said once, where it is named."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from stages import findings, said, volume

from usdvol_lint.config import Config, Depth
from usdvol_lint.engine.engine import Engine
from usdvol_lint.model import StageReport
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import Catalog

Lint = Callable[..., StageReport]


def test_payloads_that_were_not_loaded(
    catalog: Catalog, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "lib.usda").write_text(volume("asset filePath = @./gone.vdb@"))
    payload = 'def "p{}" (\n    payload = @./lib.usda@</cloud>\n)\n{{\n}}\n'
    (tmp_path / "stage.usda").write_text("#usda 1.0\n" + "".join(map(payload.format, range(5))))
    engine = Engine(catalog.rules, activate(Config(select=("ALL",)), catalog), Depth(load="none"))
    assert said(engine.lint("stage.usda")) == [
        "LNT005 5 payloads not loaded, what is below was not checked: /p0, /p1, /p2, …"
    ]


def test_missing_layers_are_known_by_their_place(lint_text: Lint, tmp_path: Path) -> None:
    """No absolute paths and no addresses: the report is the same on every machine."""
    (tmp_path / "lib.usda").write_text(
        "#usda 1.0\n(\n    subLayers = [@./sub.usda@]\n)\n"
        'def "a" (\n    references = @./other.usda@\n)\n{\n'
        '    def "c" (\n        references = </nope>\n    )\n    {\n    }\n}\n'
    )
    reference = 'def "p{}" (\n    references = @./lib.usda@</a>\n)\n{{\n}}\n'
    report = lint_text("#usda 1.0\n" + "".join(map(reference.format, range(3))))
    assert said(report) == [
        "STG001 the sublayer './sub.usda' does not exist; what it holds was not checked",
        "STG001 the reference './other.usda' does not exist; what it holds was not checked "
        "(on 3 prims)",
        "STG002 unresolved reference prim path @lib.usda@</nope> introduced by @lib.usda@</a/c> "
        "(on 3 prims)",
    ]
    assert [(f.site.layer, f.site.line) for f in findings(report)] == [
        ("lib.usda", 3),
        ("lib.usda", 6),
        ("lib.usda", 9),
    ]


def test_misspelt_layers(lint_text: Lint, tmp_path: Path) -> None:
    (tmp_path / "library.usda").write_text("#usda 1.0\n")
    report = lint_text('#usda 1.0\ndef "a" (\n    references = @./libary.usda@\n)\n{\n}\n')
    assert said(report) == [
        "STG001 the reference './libary.usda' does not exist; what it holds was not checked -> did "
        "you mean './library.usda'?"
    ]


def test_layers_that_are_there_and_do_not_open(lint_text: Lint, tmp_path: Path) -> None:
    """What is wrong with the file is said; where it lies on this machine is not."""
    (tmp_path / "empty.usda").touch()
    (tmp_path / "folder.usda").mkdir()
    (tmp_path / "broken.usda").write_text('#usda 1.0\ndef "a" (\n')
    names = ("empty", "folder", "broken")
    arcs = (f'def "{name}" (\n    references = @./{name}.usda@\n)\n{{\n}}\n' for name in names)
    broken, empty, folder = said(lint_text("#usda 1.0\n" + "".join(arcs)))
    unchecked = "; what it holds was not checked"
    assert (
        empty
        == f"STG001 the reference './empty.usda' can't be read: it is a file of 0 bytes{unchecked}"
    )
    assert (
        folder == f"STG001 the reference './folder.usda' can't be read: it is a folder{unchecked}"
    )
    assert broken.startswith("STG001 the reference './broken.usda' can't be read: ")
    assert str(tmp_path) not in broken


def test_unset_variables_in_arcs(lint_text: Lint) -> None:
    report = lint_text('#usda 1.0\ndef "a" (\n    references = @`"./${SET}.usda"`@\n)\n{\n}\n')
    assert said(report) == [
        "STG001 the reference '`\"./${SET}.usda\"`' does not exist; what it holds was not checked"
    ]
