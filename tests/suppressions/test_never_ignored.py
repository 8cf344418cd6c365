"""What no suppression hides, and that nothing is asked on a healthy stage."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from process import environment
from stagetexts import field, found, on_layer, on_prim, prim

from usdvol_lint.engine.engine import Engine
from usdvol_lint.model import Finding, Severity
from usdvol_lint.packs.activation import ActiveRules
from usdvol_lint.packs.catalog import Catalog
from usdvol_lint.rule import Problem, Rule

Lint = Callable[..., tuple[Finding, ...]]


def _fails(prim: Any, facts: Any) -> Iterator[Problem]:
    yield Problem("it is here", at=prim, holds=lambda: 1 // (prim.GetName() != "Unsure"))
    if prim.GetName() == "Rough":
        raise ValueError("rough")


def test_that_a_rule_failed_is_never_ignored(catalog: Catalog, tmp_path: Path) -> None:
    """Who says so is told, also where nothing else was found."""
    rule = Rule("ZZZ001", "rough", ("Xform",), Severity.ERROR, "0.1", _fails, {})
    levels = dict.fromkeys(("LNT002", "LNT003", "ZZZ001"), Severity.ERROR)
    engine = Engine({**catalog.rules, "ZZZ001": rule}, ActiveRules(levels, {}))
    why = on_prim(ZZZ001="why", LNT002="why")
    stage = tmp_path / "stage.usda"
    stage.write_text(f"#usda 1.0\n{prim('Rough', why)}{prim('Unsure', why)}", encoding="utf-8")
    assert sorted(found(engine.lint(str(stage)).findings)) == sorted(
        (code, path, "why" if code == "ZZZ001" else None)
        for code in ("LNT002", "LNT003", "ZZZ001")
        for path in ("/Rough", "/Unsure")
    )


def _only_fails(prim: Any, facts: Any) -> Iterator[Problem]:
    raise ValueError("rough")
    yield


def test_where_only_a_rule_failed_prims_are_asked_too(catalog: Catalog, tmp_path: Path) -> None:
    rule = Rule("ZZZ001", "rough", ("Xform",), Severity.ERROR, "0.1", _only_fails, {})
    levels = dict.fromkeys(("LNT002", "LNT003", "ZZZ001"), Severity.ERROR)
    engine = Engine({**catalog.rules, "ZZZ001": rule}, ActiveRules(levels, {}))
    stage = tmp_path / "stage.usda"
    stage.write_text(f"#usda 1.0\n{prim('Rough', on_prim(LNT002='why'))}", encoding="utf-8")
    assert found(engine.lint(str(stage)).findings) == [
        ("LNT002", "/Rough", None),
        ("LNT003", "/Rough", None),
    ]


def test_what_the_machine_lacks_no_layer_can_ignore(lint: Lint) -> None:
    """But a prim can: it is there that it shows."""
    text = field(file="gone").replace("@./gone.vdb@", "@studio://gone.vdb@")
    assert found(lint({"stage.usda": on_layer(AST010="layer") + text})) == [
        ("AST010", "/density", None)
    ]
    text = text.replace("(\n\n)", f"(\n{on_prim(AST010='prim')})")
    assert found(lint({"stage.usda": text})) == [("AST010", "/density", "prim")]


_PROGRAM = """
import sys
from usdvol_lint.config import Config
from usdvol_lint.engine.engine import Engine
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import load
catalog = load()
engine = Engine(catalog.rules, activate(Config(), catalog))
for name in ("healthy.usda", "other.usda"):
    findings = engine.lint(name).findings
    print(len(findings), "usdvol_lint.engine.suppressions" in sys.modules)
"""


def test_a_healthy_stage_pays_nothing(tmp_path: Path) -> None:
    """Nothing is asked on it, whatever it ignores, since what asks is not even imported."""
    ignored = on_layer(AST002="layer")
    healthy = ignored + prim("A", on_prim(AST002="why"), inside=prim("B", kind="def Cube"))
    (tmp_path / "healthy.usda").write_text(f"#usda 1.0\n{healthy}", encoding="utf-8")
    (tmp_path / "other.usda").write_text(f"#usda 1.0\n{ignored}{field()}", encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-P", "-c", _PROGRAM],
        cwd=tmp_path,
        env=environment(),
        capture_output=True,
        text=True,
        check=True,
    )
    first, second = done.stdout.splitlines()
    assert first == "0 False"
    assert second.endswith("True")
