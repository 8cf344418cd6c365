"""`extend`: what a studio's file says holds where the show's own file says nothing else."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from process import AS_JSON, STUDIO, Ran, run, settings, volume, write

from usdvol_lint.config.files import read_config


@pytest.fixture
def show(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of a show, beside that of the studio, which has a pack of rules."""
    (tmp_path / "studio").mkdir()
    (tmp_path / "show").mkdir()
    shutil.copytree(STUDIO, tmp_path / "studio" / "rules")
    return tmp_path / "show"


def path(folder: str | Path, name: str) -> str:
    """A path as messages have it: `..` stays."""
    return str(Path(folder) / name)


def configure(show: Path, studio: str, own: str) -> Path:
    (show.parent / "studio" / "usdvol-lint.toml").write_text(studio, encoding="utf-8")
    file = show / "usdvol-lint.toml"
    file.write_text(f"extend = '../studio/usdvol-lint.toml'\n{own}", encoding="utf-8")
    return file


def test_what_becomes_of_each_kind_of_key(show: Path) -> None:
    file = configure(
        show,
        """
select = ["STU", "VOL"]
ignore = ["STU002"]
packs = ["rules"]
show = ["known"]
fail-on = "warning"
timeout = 7
root = "."
severity = { STU001 = "info", STU002 = "info" }
options.STU001 = { strict = true, prefix = "x" }
suppress = [{ files = "a", reason = "studio" }]
per-path = [{ files = "a", ignore = ["STU"] }]
""",
        """
select = ["STU"]
ignore = ["STU001"]
show = ["info"]
fail-on = "error"
severity = { STU001 = "error" }
options.STU001 = { prefix = "y" }
options.STU002 = {}
suppress = [{ files = "b", reason = "show" }]
per-path = [{ files = "b", ignore = ["STU"] }]
""",
    )
    config = read_config(file)
    studio = path(show, "../studio")
    assert config.select == ("STU",)
    assert config.ignore == ("STU002", "STU001")
    assert config.packs == (path(studio, "rules"),)
    assert config.show == ("known", "info")
    assert (config.fail_on, config.timeout, config.root) == ("error", 7.0, studio)
    assert list(config.severity.items()) == [("STU002", "info"), ("STU001", "error")]
    assert config.options == {"STU001": {"strict": True, "prefix": "y"}, "STU002": {}}
    assert [each.reason for each in config.suppress] == ["show", "studio"]
    assert [each.files for each in config.per_path] == [("a",), ("b",)]


def test_messages_name_the_file_that_says_it(show: Path, tool: Callable[..., Ran]) -> None:
    own, studio = (path(each, "usdvol-lint.toml") for each in ("show", "show/../studio"))
    none = "is no rule, no family and no beginning of a code"
    for wanted, where, said in (
        ("ignore = ['XYZ']", "ignore", f"'XYZ' {none}"),
        ("select = ['XYZ']", "select", f"'XYZ' {none}"),
        ("severity = { XYZ = 'info' }", "severity.XYZ", f"'XYZ' {none}"),
        ("options.XYZ.a = 1", "options.XYZ", "no rule 'XYZ'"),
        ("options.AST002.a = 1", "options.AST002.a", "file-missing has no option 'a'"),
        ("per-path = [{ files = 'a', ignore = ['XYZ'] }]", "per-path, table 1: ignore", "'XYZ' "),
        ("ignore = ['LNT001']", "ignore", "LNT001 can't be ignored"),
    ):
        configure(show, wanted, "fail-on = 'info'")
        err = tool("--show-settings", "--config", own).err
        assert err.startswith(f"usdvol-lint: error: {studio}: {where}: {said}")
        configure(show, "fail-on = 'info'", wanted)
        err = tool("--show-settings", "--config", own).err
        assert err.startswith(f"usdvol-lint: error: {own}: {where}: {said}")
    configure(show, "packs = ['gone']", "")
    err = tool("--show-settings", "--config", own).err
    assert err.startswith(f"usdvol-lint: error: {studio}: packs: there is no folder ")
    configure(show, "root = 'gone'", "")
    assert f"error: {studio}: root: the root " in tool("--config", own, ".").err
    configure(show, "baseline = 'gone.jsonl'", "")
    assert f"error: {studio}: baseline: studio/gone.jsonl: " in tool("--config", own, ".").err
    configure(show, "show = ['unused']", "times = 1")
    assert tool("--show-settings", "--config", own).err == (
        f"usdvol-lint: error: {studio}: show = 'unused' needs a run that looks at everything: "
        f"leave out {own}: times = '1'\n"
    )


def test_each_pack_is_known_by_the_file_that_says_it(show: Path) -> None:
    (show / "own").mkdir()
    config = read_config(configure(show, "packs = ['rules']", "packs = ['own']"))
    files = [config.origins.of("packs", pack).file for pack in config.packs]
    assert files == [path(show, "../studio/usdvol-lint.toml"), path(show, "usdvol-lint.toml")]


@pytest.mark.parametrize(
    ("studio", "own", "arguments", "on"),
    [
        ("ignore = ['STU002']", "select = ['STU']", "", "STU001"),
        ("ignore = ['STU002']", "select = ['STU002']", "", "STU002"),
        ("ignore = ['STU002']", "select = ['volume-seen']", "", "STU002"),
        ("select = ['STU002']", "ignore = ['STU002']", "", ""),
        ("", "select = ['STU002']\nignore = ['STU002']", "", ""),
        ("ignore = ['STU002']", "", "--select STU002", "STU002"),
        ("ignore = ['STU002']", "ignore = ['STU002']", "--select STU002", "STU002"),
        ("select = []", "", "", ""),
        ("select = ['STU']", "select = []", "", ""),
    ],
)
def test_what_is_selected_above_is_not_ignored_below(
    studio: str, own: str, arguments: str, on: str, show: Path, tool: Callable[..., Ran]
) -> None:
    file = configure(show, f"packs = ['rules']\n{studio}", own)
    rules = settings(tool(*AS_JSON, "--config", file, *arguments.split()))["rules"]
    assert " ".join(code for code in rules if code.startswith("STU")) == on


def test_a_chain_from_one_project_to_another(show: Path, tool: Callable[..., Ran]) -> None:
    """Each path is relative to its own file."""
    file = configure(show, "extend = 'base/pyproject.toml'\ntimeout = 7", "")
    base = show.parent / "studio" / "base"
    base.mkdir()
    (base / "pyproject.toml").write_text("[tool.usdvol-lint]\npacks = ['../rules']\njobs = 3\n")
    write(show, fog=volume("fog"))
    named = ("--config", file, "--select", "STU001")
    ran = run(*named, "-v", "--output-format", "json", "fog.usda", cwd=show)
    assert ran.json["settings"]["timeout"] == 7
    assert [cause["code"] for cause in ran.json["causes"]] == ["STU001"]
    names = ("usdvol-lint.toml", "../studio/usdvol-lint.toml", "../studio/base/pyproject.toml")
    files = [path(show, name) for name in names]
    run_info = ran.json["run"]
    assert [run_info["config_file"], *run_info["config_extends"]] == files
    text = run(*named, "-v", "fog.usda", cwd=show).out
    assert text.splitlines()[-1] == (
        f"configuration: {files[0]}, which extends {files[1]}, {files[2]}"
    )
    assert "configuration" not in run(*named, "fog.usda", cwd=show).out
    assert run("--isolated", "-v", "fog.usda", cwd=show).out.endswith("configuration: none\n")


def test_a_circle_is_named(show: Path, tool: Callable[..., Ran]) -> None:
    file = configure(show, "extend = '../show/usdvol-lint.toml'", "")
    studio = path(show, "../studio/usdvol-lint.toml")
    again = path(show, "../studio/../show/usdvol-lint.toml")
    assert tool("--show-settings", "--config", file).err == (
        f"usdvol-lint: error: {studio}: extend: the files extend each other in a circle: "
        f"{file} -> {studio} -> {again}\n"
    )
    file.write_text("extend = 'usdvol-lint.toml'\n", encoding="utf-8")
    assert "in a circle" in tool("--show-settings", "--config", file).err


@pytest.mark.parametrize(
    ("own", "said"),
    [
        ("'../gone.toml'", "extend: there is no file '{show}/../gone.toml'"),
        ("'../studio'", "extend: '{show}/../studio' is a folder and no file"),
        ("'pyproject.toml'", "extend: {show}/pyproject.toml has no table [tool.usdvol-lint]"),
        ("''", "extend must not be empty: leave it out"),
        ("['a.toml']", "extend must be a text, not ['a.toml']"),
    ],
)
def test_what_can_not_be_extended(
    own: str, said: str, show: Path, tool: Callable[..., Ran]
) -> None:
    """Both files are named."""
    file = show / "usdvol-lint.toml"
    (show / "pyproject.toml").touch()
    file.write_text(f"extend = {own}\n", encoding="utf-8")
    wanted = f"usdvol-lint: error: {file}: {said.format(show=show).replace('/', os.sep)}\n"
    assert tool("--show-settings", "--config", file) == Ran(2, "", wanted)
