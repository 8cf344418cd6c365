"""Who misnames our file or our table is told, and other tools' are none of our business."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from process import AS_JSON, Ran, settings


@pytest.mark.parametrize(
    ("table", "called"),
    [
        ("[tool.usdvol_lint]", "tool.usdvol_lint"),
        ("[tool.usdvollint]", "tool.usdvollint"),
        ("[tool.USDVol-Lint]", "tool.USDVol-Lint"),
        ('[tool."usdvol.lint"]', "tool.usdvol.lint"),
        ("[tool.usdvol.lint]\nfail-on = 'info'", "tool.usdvol.lint"),
        ("[tool.usdvol]\nfail_on = 'info'", "tool.usdvol"),
        ("[tool.usdvol-lnt]\nignore = []", "tool.usdvol-lnt"),
        ("[tools.usdvol-lint]", "tools.usdvol-lint"),
        ("[usdvol-lint]", "usdvol-lint"),
        ("[usdvol_lint]", "usdvol_lint"),
        ("[tool.usdvol-lint]\n[tool.usdvol_lint.severity]", "tool.usdvol_lint"),
    ],
)
def test_a_misnamed_table(
    table: str, called: str, tool: Callable[..., Ran], tmp_path: Path
) -> None:
    file = tmp_path / "pyproject.toml"
    file.write_text(f"{table}\n", encoding="utf-8")
    said = f"the table [{called}] is not read: call it [tool.usdvol-lint]"
    assert tool("--show-settings") == Ran(2, "", f"usdvol-lint: error: {file}: {said}\n")
    ran = tool("--show-settings", "--config", "pyproject.toml")
    assert ran == Ran(2, "", f"usdvol-lint: error: pyproject.toml: {said}\n")
    assert tool("--show-settings", "--isolated").code == 0


@pytest.mark.parametrize(
    "table",
    [
        "[tool.usdvol]",
        "[tool.usdvol]\nresolution = 3\nignore = []",
        "[tool.usdvol.lint]\nflake = true",
        "[tool.usdvol-hint]\nresolution = 3",
        "[tool.usd-lint]\nignore = ['x']",
        "[tool.usdlint]\nselect = ['x']",
        "[tool]\nusdvol = 'x'",
        "tools = 3",
    ],
)
def test_tables_of_other_tools(table: str, tool: Callable[..., Ran], tmp_path: Path) -> None:
    (tmp_path / "pyproject.toml").write_text(f"{table}\n", encoding="utf-8")
    assert settings(tool(*AS_JSON))["config_file"] is None


@pytest.mark.parametrize("name", ["usdvol_lint.toml", ".usdvol-lint.toml", "usdvollint.toml"])
def test_a_misnamed_file(name: str, tool: Callable[..., Ran], tmp_path: Path) -> None:
    """Also beside one that is read; named with --config, it may be called as it likes."""
    file = tmp_path / name
    file.write_text("fail-on = 'info'\n", encoding="utf-8")
    said = f"usdvol-lint: error: {file} is not read: call it usdvol-lint.toml\n"
    assert tool("--show-settings") == Ran(2, "", said)
    (tmp_path / "usdvol-lint.toml").touch()
    assert tool("--show-settings") == Ran(2, "", said)
    assert settings(tool(*AS_JSON, "--config", name))["fail_on"] == "info"


@pytest.mark.parametrize("table", ["tool.usdvol-lint", "usdvol-lint"])
def test_a_table_where_none_is_needed(table: str, tool: Callable[..., Ran], tmp_path: Path) -> None:
    file = tmp_path / "usdvol-lint.toml"
    file.write_text(f"[{table}]\nfail-on = 'info'\n", encoding="utf-8")
    said = f"{file}: the keys stand at the top of this file: leave out [{table}]"
    assert tool("--show-settings") == Ran(2, "", f"usdvol-lint: error: {said}\n")
