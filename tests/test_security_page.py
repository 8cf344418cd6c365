"""docs/security.md names tests that there are, and each line of it one."""

from __future__ import annotations

import ast
import re

from process import ROOT

PAGE = (ROOT / "docs" / "security.md").read_text(encoding="utf-8")
NAMED = re.compile(r"`(?P<module>test_\w+)::(?P<test>test_\w+)`")
ROWS = [line for line in PAGE.splitlines() if line.startswith("| ")]
HEADS = [line for line in ROWS if line.endswith("| held by |")]


def test_each_line_names_a_test() -> None:
    for row in ROWS:
        assert row in HEADS or NAMED.search(row.rpartition(" | ")[2]), row


def test_each_test_is_there() -> None:
    modules = {path.stem: path for path in (ROOT / "tests").rglob("test_*.py")}
    for found in NAMED.finditer(PAGE):
        tree = ast.parse(modules[found["module"]].read_text(encoding="utf-8"))
        tests = {node.name for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)}
        assert found["test"] in tests, found[0]
