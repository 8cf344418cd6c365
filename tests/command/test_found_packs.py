"""Rules are code: a configuration that was found, and not named, loads them from no folder."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from process import ROOT, STUDIO, Ran, environment, run, volume, write


def said(file: str | Path, folder: str, found: str) -> str:
    return (
        f"usdvol-lint: error: {file}: packs: '{folder}' is no installed pack, and a configuration "
        "that was found loads no folder of rules, which are code: name it yourself with --pack "
        f"{folder}, or the configuration with --config {found}\n"
    )


@pytest.fixture
def checkout(tmp_path: Path) -> Path:
    """A folder with a stage, and with a pack that leaves a mark where it is imported."""
    folder = write(tmp_path / "checkout", fog=volume("fog"))
    (folder / "rules").mkdir()
    (folder / "rules" / "own.py").write_text("open('ran', 'w').close()\n", encoding="utf-8")
    return folder


@pytest.mark.parametrize("asked", [".", "--show-settings", "--list-rules", "--explain=AST002"])
def test_a_found_configuration_names_no_folder(
    asked: str, checkout: Path, monkeypatch: pytest.MonkeyPatch, tool: Callable[..., Ran]
) -> None:
    monkeypatch.chdir(checkout)
    own = checkout / "usdvol-lint.toml"
    own.write_text("packs = ['rules']\n", encoding="utf-8")
    assert tool(asked) == Ran(2, "", said(own, "rules", "usdvol-lint.toml"))
    named = ("--config", "usdvol-lint.toml")
    assert "holds no rule" in tool(*named, asked).err, "what is named is loaded"
    (checkout / "ran").unlink()
    project = checkout / "pyproject.toml"
    own.rename(project)
    project.write_text("[tool.usdvol-lint]\npacks = ['./rules/.']\n", encoding="utf-8")
    assert tool(asked) == Ran(2, "", said(project, "rules", "pyproject.toml"))
    assert not (checkout / "ran").exists()


def test_nor_does_what_it_extends(
    checkout: Path, monkeypatch: pytest.MonkeyPatch, tool: Callable[..., Ran]
) -> None:
    (checkout / "base.toml").write_text("packs = ['rules']\n", encoding="utf-8")
    (checkout / "usdvol-lint.toml").write_text("extend = 'base.toml'\n", encoding="utf-8")
    monkeypatch.chdir(write(checkout / "sub"))
    error = said(checkout / "base.toml", "../rules", "../usdvol-lint.toml")
    assert tool("..", "--pack", STUDIO) == Ran(2, "", error)


def test_an_installed_pack_is_named(checkout: Path, tmp_path: Path) -> None:
    """Also where a folder of that name lies beside the configuration: that is not it."""
    site = tmp_path / "site"
    shutil.copytree(STUDIO, site / "studio_rules")
    (site / "studio_rules" / "__init__.py").touch()
    info = write(site / "studio_rules-1.0.dist-info")
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: studio-rules\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text("[usdvol_lint.packs]\nrules = studio_rules\n")
    shutil.copytree(checkout / "rules", checkout / "studio_rules")
    text = "packs = ['rules']\nselect = ['STU001']\n"
    (checkout / "usdvol-lint.toml").write_text(text, encoding="utf-8")
    env = environment(PYTHONPATH=os.pathsep.join([str(ROOT), str(site)]))
    for named in ((), ("--config", "usdvol-lint.toml")):
        ran = run(*named, "--output-format", "json", ".", cwd=checkout, env=env)
        assert [cause["code"] for cause in ran.json["causes"]] == ["STU001"]
    assert run(".", cwd=checkout).code == 2, "where it is not installed"
    assert not (checkout / "ran").exists()
