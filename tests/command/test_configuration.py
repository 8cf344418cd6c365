"""Configuration files: which one counts, what it says, and what is wrong with it."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import click
import pytest
from process import AS_JSON, ROUGH, STUDIO, Ran, run, settings, volume, write

from usdvol_lint import __version__
from usdvol_lint.command import cli
from usdvol_lint.config import Config
from usdvol_lint.config.values import CHECKS

TOO_LARGE = "has a number of more than 64 bits, which no setting is"
NUL = "has a NUL character, which nothing is called: leave it out"


def test_every_setting_has_a_check() -> None:
    """But for where they are said; `extend` is none, but what they are read from."""
    settings = tuple(key.replace("-", "_") for key in CHECKS if key != "extend")
    assert (*settings, "origins") == Config._fields


def test_the_nearest_configuration_counts(tool: Callable[..., Ran], tmp_path: Path) -> None:
    shot = tmp_path / "show" / "shot"
    shot.mkdir(parents=True)
    os.chdir(shot)
    assert settings(tool(*AS_JSON))["config_file"] is None

    outer = tmp_path / "pyproject.toml"
    outer.write_text('[tool.usdvol-lint]\nfail-on = "info"\n', encoding="utf-8")
    (tmp_path / "show" / "pyproject.toml").write_text("[tool.other]\nx = 1\n", encoding="utf-8")
    found = settings(tool(*AS_JSON))
    assert (found["config_file"], found["fail_on"]) == (str(outer), "info")

    own = tmp_path / "show" / "usdvol-lint.toml"
    own.write_text('fail-on = "never"\n', encoding="utf-8")
    found = settings(tool(*AS_JSON))
    assert (found["config_file"], found["fail_on"]) == (str(own), "never")

    found = settings(tool(*AS_JSON, "--fail-on", "warning"))
    assert (found["config_file"], found["fail_on"]) == (str(own), "warning")
    found = settings(tool(*AS_JSON, "--isolated"))
    assert (found["config_file"], found["fail_on"]) == (None, "error")
    found = settings(tool(*AS_JSON, "--config", "../../pyproject.toml"))
    assert (found["config_file"], found["fail_on"]) == (str(Path("../../pyproject.toml")), "info")


def test_a_configuration_next_to_the_linted_file_does_not_count(tmp_path: Path) -> None:
    """It came with the file, and could load code."""
    stranger = write(tmp_path / "stranger", fog=volume("fog"))
    (stranger / "usdvol-lint.toml").write_text(f"packs = ['{ROUGH}']\n", encoding="utf-8")
    home = write(tmp_path / "home")
    ran = run("../stranger", "--output-format", "json", "--select", "LNT", cwd=home)
    assert ran.json["settings"]["packs"] == []


def test_keys(tool: Callable[..., Ran], tmp_path: Path) -> None:
    (tmp_path / "pack").symlink_to(STUDIO, target_is_directory=True)
    (tmp_path / "usdvol-lint.toml").write_text(
        """
select = ["STU"]
ignore = ["STU002"]
packs = ["pack"]
fail-on = "warning"
output-format = "json"
show = ["info"]
load = "none"
variants = "all"
variant-limit = 7
jobs = 2
timeout = 12
severity = { STU001 = "info" }
[options.volume-name]
allowed = ["fog"]
share = 2
[options.STU001]
strict = true
""",
        encoding="utf-8",
    )
    expected = {
        "config_file": str(tmp_path / "usdvol-lint.toml"),
        "rules": {"LNT001": "error", "LNT002": "error", "STU001": "info"},
        "options": {"volume-name": {"allowed": ["fog"], "share": 2}, "STU001": {"strict": True}},
        "packs": [str(tmp_path / "pack")],
        "fail_on": "warning",
        "show": ["info"],
        "load": "none",
        "variants": "all",
        "variant_limit": 7,
        "timeout": 12.0,
    }
    shown = settings(tool(*AS_JSON, "--config", tmp_path / "usdvol-lint.toml"))
    assert {key: shown[key] for key in expected} == expected


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("fail_on = 'info'", "unknown key 'fail_on'; did you mean 'fail-on'?"),
        ("xyzzy = 1", "unknown key 'xyzzy'"),
        (
            "fail-on = 'infos'",
            "fail-on must be one of error, warning, info, never, not 'infos'; did you mean 'info'?",
        ),
        ("fail-on = 3", "fail-on must be one of error, warning, info, never, not 3"),
        ("load = []", "load must be one of all, none, not []"),
        ("variants = true", "variants must be one of selected, all, not True"),
        ("variant-limit = 0", "variant-limit must be a whole number from 1, not 0"),
        ("select = 'AST'", "select must be a list of strings, not 'AST'"),
        ("show = 'info'", "show must be a list of strings, not 'info'"),
        (
            "show = ['infos']",
            "show must be one of info, known, suppressed, unused, not 'infos'; "
            "did you mean 'info'?",
        ),
        ("ignore = ['AST', 3]", "ignore must be a list of strings, not ['AST', 3]"),
        ("packs = true", "packs must be a list of strings, not True"),
        ("packs = ['']", "packs has an empty string, which names nothing: leave it out"),
        ("select = ['AST', ' ']", "select has an empty string, which names nothing: leave it out"),
        ("severity = 'error'", "severity must be a table, not 'error'"),
        (
            "severity.AST002 = false",
            "severity.AST002 must be one of error, warning, info, not False; "
            "a rule that is to report nothing stands in `ignore`",
        ),
        (
            "severity.asse = 'info'",
            "severity.asse: 'asse' is no rule, no family and no beginning of a code; "
            "did you mean 'asset'?",
        ),
        (
            "severity.AST002 = 'errors'",
            "severity.AST002 must be one of error, warning, info, not 'errors'; "
            "did you mean 'error'?",
        ),
        ("options = 3", "options must be a table, not 3"),
        ("options.file-missing = 3", "options.file-missing must be a table, not 3"),
        ("jobs = 1.5", "jobs must be a whole number from 0, not 1.5"),
        ("jobs = true", "jobs must be a whole number from 0, not True"),
        ("jobs = -1", "jobs must be a whole number from 0, not -1"),
        (f"jobs = 0x{'f' * 9000}", f"jobs {TOO_LARGE}"),
        (f"timeout = {1 << 63}", f"timeout {TOO_LARGE}"),
        (f"options.file-missing.most = [-{1 << 63}]", f"options {TOO_LARGE}"),
        ('root = "a\\u0000b"', f"root {NUL}"),
        ('extend = "a\\u0000b"', f"extend {NUL}"),
        ('path-map = { "a\\u0000" = "b" }', f"path-map {NUL}"),
        ('stages = ["\\U00000000"]', f"stages {NUL}"),
        ("timeout = 0", "timeout must be a number of seconds above 0, at most 1,000,000, not 0"),
        (
            "timeout = inf",
            "timeout must be a number of seconds above 0, at most 1,000,000, not inf",
        ),
        (
            "timeout = '9'",
            "timeout must be a number of seconds above 0, at most 1,000,000, not '9'",
        ),
        (
            "xyzzy = 1\nrequired-version = '>=99,<100'",
            f"required-version is '>=99,<100', and this is usdvol-lint {__version__}: "
            "install one that is wanted, or change the key",
        ),
        (
            "required-version = '~=0.1'",
            "required-version must be a text such as '>=0.1,<0.2', or '0.1' for that and its "
            "patches, not '~=0.1'",
        ),
        (
            "required-version = 0.1",
            "required-version must be a text such as '>=0.1,<0.2', or '0.1' for that and its "
            "patches, not 0.1",
        ),
        (
            "rules-as-of = 0.1",
            "rules-as-of must be the number of a release as a text, such as '0.1', not 0.1",
        ),
        (
            "rules-as-of = 'v1'",
            "rules-as-of must be the number of a release as a text, such as '0.1', not 'v1'",
        ),
    ],
)
def test_mistakes_in_a_configuration(
    text: str, said: str, tool: Callable[..., Ran], tmp_path: Path
) -> None:
    file = tmp_path / "usdvol-lint.toml"
    file.write_text(text, encoding="utf-8")
    assert tool("--show-settings") == Ran(2, "", f"usdvol-lint: error: {file}: {said}\n")


@pytest.mark.parametrize(
    ("name", "data", "said"),
    [
        ("usdvol-lint.toml", b"select = [", "Invalid value (at end of document)"),
        ("usdvol-lint.toml", b"a = 1\na = 2\n", "Cannot overwrite a value (at line 2, column 6)"),
        ("usdvol-lint.toml", b"# \xff\n", "not UTF-8 text"),
        ("usdvol-lint.toml", b"\xff\xfej\0", "this is UTF-16 text, write the file as UTF-8"),
        ("usdvol-lint.toml", b"\xfe\xff\0j", "this is UTF-16 text, write the file as UTF-8"),
        (
            "usdvol-lint.toml",
            b"a" + b".a" * 100_000 + b" = 1\n",
            "no configuration has more than 4,194,304 bytes, ",
        ),
        ("usdvol-lint.toml", b"jobs = " + b"9" * 5_000, "has a number of too many digits"),
        ("usdvol-lint.toml", b"select = " + b"[" * 5_000, "has too many brackets in one another"),
        ("pyproject.toml", b"[tool\n", "Expected ']' at the end of a table declaration"),
        ("pyproject.toml", b"[tool]\nusdvol-lint = 3\n", "tool.usdvol-lint must be a table, not 3"),
    ],
)
def test_a_file_that_is_no_configuration(
    name: str, data: bytes, said: str, tool: Callable[..., Ran], tmp_path: Path
) -> None:
    (tmp_path / name).write_bytes(data)
    ran = tool("--show-settings")
    assert (ran.code, ran.out) == (2, "")
    assert ran.err.startswith(f"usdvol-lint: error: {tmp_path / name}: {said}")
    assert ran.err.count("\n") == 1


@pytest.mark.skipif(os.name != "posix", reason="needs links, pipes and devices of POSIX")
@pytest.mark.parametrize("name", ["usdvol-lint.toml", "pyproject.toml"])
def test_what_is_no_file_is_not_passed_over(
    name: str, tool: Callable[..., Ran], tmp_path: Path
) -> None:
    file = tmp_path / name
    for kind, make in {
        "a link that leads nowhere": lambda: file.symlink_to("gone.toml"),
        "a pipe or a device": lambda: os.mkfifo(file),
    }.items():
        make()
        said = f"'{file}' is {kind} and no file: take it away, or write it anew"
        done = tool("--show-settings")
        assert (done.code, done.out, done.err) == (2, "", f"usdvol-lint: error: {said}\n")
        file.unlink()


def test_a_folder_with_the_name_of_our_file(tool: Callable[..., Ran], tmp_path: Path) -> None:
    """One that is called like the file of a project has no table of ours, and means nothing."""
    (tmp_path / "pyproject.toml").mkdir()
    assert tool("--show-settings").code == 0
    (tmp_path / "usdvol-lint.toml").mkdir()
    done = tool("--show-settings")
    assert (done.code, "is a folder and no file" in done.err) == (2, True)


def test_a_project_without_our_table(tool: Callable[..., Ran], tmp_path: Path) -> None:
    (tmp_path / "pyproject.toml").write_text("tool = 3\n", encoding="utf-8")
    assert settings(tool(*AS_JSON))["config_file"] is None
    assert tool("--config", "", ".").err.startswith(
        "usdvol-lint: error: --config has an empty value: "
    )
    said = "usdvol-lint: error: pyproject.toml has no table [tool.usdvol-lint]\n"
    assert tool("--show-settings", "--config", "pyproject.toml") == Ran(2, "", said)


@pytest.mark.parametrize(
    ("name", "said"), [("gone.toml", "No such file or directory"), ("folder", "Is a directory")]
)
def test_a_configuration_that_can_not_be_read(
    name: str, said: str, tool: Callable[..., Ran], tmp_path: Path
) -> None:
    (tmp_path / "folder").mkdir()
    ran = tool("--show-settings", "--config", name)
    assert (ran.code, ran.out) == (2, "")
    assert ran.err.startswith(f"usdvol-lint: error: {name}: ")
    if os.name == "posix":
        assert ran.err.endswith(f": {said}\n")


def test_this_version_is_wanted(tool: Callable[..., Ran], tmp_path: Path) -> None:
    for wanted in (__version__, f">={__version__}", ">=0.0.1,<99"):
        text = f"xyzzy = 1\nrequired-version = '{wanted}'\n"
        (tmp_path / "usdvol-lint.toml").write_text(text, encoding="utf-8")
        assert tool("--show-settings").err.endswith("usdvol-lint.toml: unknown key 'xyzzy'\n")


def test_configuration_shapes_a_run(tmp_path: Path) -> None:
    write(tmp_path, fog=volume("fog"), mist=volume("mist"))
    (tmp_path / "usdvol-lint.toml").write_text(
        f"""
packs = ['{os.path.relpath(STUDIO, tmp_path)}']
select = ["STU001"]
severity = {{ STU001 = "warning" }}
output-format = "concise"
fail-on = "warning"
options.volume-name.allowed = ["fog"]
""",
        encoding="utf-8",
    )
    ran = run("--config", "usdvol-lint.toml", ".", cwd=tmp_path)
    said = "mist.usda:2:1: STU001 warning </mist> name 'mist', wanted fog\n"
    assert ran == Ran(1, said, "")


def test_a_byte_order_mark_is_no_text(tool: Callable[..., Ran], tmp_path: Path) -> None:
    (tmp_path / "usdvol-lint.toml").write_text("jobs = 3\n", encoding="utf-8-sig")
    assert "jobs = 3 " in tool("--show-settings").out


@pytest.mark.parametrize("option", [
    each.opts[0] for each in cli.command.params
    if isinstance(each, click.Option) and not each.is_flag
    and isinstance(each.type, click.Path | click.types.StringParamType)
])  # fmt: skip
def test_no_option_has_an_empty_value(
    option: str, tool: Callable[..., Ran], tmp_path: Path
) -> None:
    """A variable of a script that is not set switches nothing off."""
    write(tmp_path, smoke=volume("smoke"))
    said = f"{option} has an empty value: if a script brings it, its variable is not set; "
    for value in ("", " "):
        ran = tool("--isolated", f"{option}={value}", "smoke.usda")
        assert (ran.code, ran.out) == (2, "")
        assert ran.err.startswith(f"usdvol-lint: error: {said}")
