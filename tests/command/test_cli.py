"""The command line: options, configuration files, streams and exit codes."""

from __future__ import annotations

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from process import PROGRAM, ROUGH, STUDIO, Ran, environment, run, volume, write

from usdvol_lint import __version__
from usdvol_lint.command import cli
from usdvol_lint.config import CHECKS, OUTPUT_FORMATS, Config
from usdvol_lint.packs.catalog import load
from usdvol_lint.report import FORMATS

ONLY_STUDIO = ("--isolated", "--pack", STUDIO, "--select", "STU")
WRONG = "name 'fog', wanted smoke, fire"


@pytest.fixture
def tool(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> Callable[..., Ran]:
    """The command in this process, in a temporary folder: for all that starts no other process."""
    monkeypatch.chdir(tmp_path)
    for name in ("NO_COLOR", "FORCE_COLOR"):
        monkeypatch.delenv(name, raising=False)

    def call(*arguments: str | Path) -> Ran:
        code = cli.main([str(argument) for argument in arguments])
        ran = Ran(code, *capfd.readouterr())
        assert "Traceback" not in ran.err
        return ran

    return call


def settings(ran: Ran) -> Any:
    """What `--show-settings` printed."""
    assert (ran.code, ran.err) == (0, "")
    return ran.json


def without_seconds(report: Any) -> Any:
    for stage in report["stages"]:
        assert stage.pop("seconds") >= 0
    return report


# --- what the tool says of itself ---------------------------------------------------------------


def test_help_names_every_option(tool: Callable[..., Ran]) -> None:
    ran = tool("--help")
    assert (ran.code, ran.err) == (0, "")
    options = [name for option in cli.command.params for name in option.opts if name[0] == "-"]
    assert len(options) > 15
    for name in options:
        assert re.search(rf"(^|[ ,/]){re.escape(name)}\b", ran.out, re.MULTILINE), name
    assert tool("-h") == ran


def test_version(tool: Callable[..., Ran]) -> None:
    assert tool("--version") == Ran(0, f"usdvol-lint {__version__}\n", "")


def test_no_paths(tool: Callable[..., Ran]) -> None:
    ran = tool()
    assert (ran.code, ran.out) == (2, "")
    assert ran.err.splitlines()[-1] == "Error: nothing to check: name a stage or a folder"


def test_list_rules(tool: Callable[..., Ran]) -> None:
    ran = tool("--list-rules", "--isolated", "--pack", STUDIO)
    catalog = load([str(STUDIO)])
    lines = ran.out.splitlines()
    assert (ran.code, ran.err) == (0, "")
    assert [line[:6] for line in lines] == list(catalog.rules)
    assert [line for line in lines if line.startswith("STU")] == [
        "STU001  error        volume-name                  A Volume has a name that nobody agreed"
        " on.",
        "STU002  warning, off volume-seen",
    ]


def test_list_rules_as_json(tool: Callable[..., Ran]) -> None:
    ran = tool("--list-rules", "--isolated", "--pack", STUDIO, "--output-format", "json")
    assert [rule["code"] for rule in ran.json] == list(load([str(STUDIO)]).rules)
    assert [rule for rule in ran.json if rule["code"].startswith("STU")] == [
        {
            "code": "STU001",
            "name": "volume-name",
            "severity": "error",
            "default": True,
            "since": "1.0",
            "summary": "A Volume has a name that nobody agreed on.",
            "options": {
                "allowed": ["smoke", "fire"],
                "prefix": "",
                "longest": 12,
                "share": 1.0,
                "strict": False,
            },
        },
        {
            "code": "STU002",
            "name": "volume-seen",
            "severity": "warning",
            "default": False,
            "since": "1.0",
            "summary": None,
            "options": {},
        },
    ]


@pytest.mark.parametrize("name", ["STU001", "stu001", "volume-name", " Volume-Name "])
def test_explain(name: str, tool: Callable[..., Ran]) -> None:
    page = (STUDIO / "house" / "volume_name.md").read_text(encoding="utf-8")
    assert tool("--isolated", "--pack", STUDIO, "--explain", name) == Ran(0, page, "")


def test_explain_in_colour_lays_the_page_out(tool: Callable[..., Ran], tmp_path: Path) -> None:
    """For a terminal, with headings and lists that look like some."""
    pack = tmp_path / "pack"
    shutil.copytree(STUDIO, pack)
    page = "# volume-name (STU001)\n\nA name.\n\n## Why it matters\n\n- *Look* is `found`.\n"
    (pack / "house" / "volume_name.md").write_text(page, encoding="utf-8")
    ran = tool("--isolated", "--pack", pack, "--explain", "STU001", "--color", "always")
    codes = re.findall("\x1b\\[([0-9;]+)m", ran.out)
    lines = [line.strip() for line in re.sub("\x1b\\[[0-9;]*m", "", ran.out).splitlines()]
    assert list(filter(None, lines)) == [
        "volume-name (STU001)",
        "A name.",
        "Why it matters",
        "\N{BULLET} Look is found.",
    ]
    assert (len(codes) >= 5, ran.code, ran.err) == (True, 0, "")


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("volum-name", "no rule 'volum-name'; did you mean 'volume-name'?"),
        ("STU01", "no rule 'STU01'; did you mean 'STU001'?"),
        ("xyzzy", "no rule 'xyzzy'"),
        ("STU002", "STU002 (volume-seen) has no page in its pack"),
    ],
)
def test_explain_what_is_not_there(name: str, said: str, tool: Callable[..., Ran]) -> None:
    ran = tool("--isolated", "--pack", STUDIO, "--explain", name)
    assert ran == Ran(2, "", f"usdvol-lint: error: {said}\n")


def test_completion(tmp_path: Path) -> None:
    script = run(cwd=tmp_path, env=environment(_USDVOL_LINT_COMPLETE="bash_source"))
    assert script.code == 0
    assert "_USDVOL_LINT_COMPLETE=bash_complete" in script.out
    words = environment(
        _USDVOL_LINT_COMPLETE="bash_complete",
        COMP_WORDS="usdvol-lint --explain lnt",
        COMP_CWORD="2",
    )
    completed = run(cwd=tmp_path, env=words)
    assert "plain,LNT001" in completed.out.split()


def test_formats_are_named_once() -> None:
    assert tuple(FORMATS) == OUTPUT_FORMATS
    words = cli.command.get_help(cli.click.Context(cli.command))
    assert all(re.search(rf"\b{name}\b", words) for name in FORMATS)


# --- selection, severity, exit code ---------------------------------------------------------------


@pytest.mark.parametrize(
    ("file", "arguments", "on"),
    [
        ("", "", "STU001"),
        ("", "--select STU", "STU001 STU002"),
        ("", "--select stu002", "STU002"),
        ("", "--select STU001,STU002", "STU001 STU002"),
        ("", "--select STU001 --select STU002", "STU001 STU002"),
        ("", "--select ALL", "STU001 STU002"),
        ("", "--ignore STU", ""),
        ("", "--ignore STU001", ""),
        ("", "--select STU --ignore STU002", "STU001"),
        ("", "--select STU002 --ignore STU", "STU002"),
        ("", "--select STU --ignore STU", ""),
        ("", "--select STU --ignore ALL", "STU001 STU002"),
        ('select = ["STU002"]', "", "STU002"),
        ('select = ["STU002"]', "--select STU001", "STU001"),
        ('select = ["STU002"]', "--ignore STU002", ""),
        ('ignore = ["STU001"]', "", ""),
        ('ignore = ["STU001"]', "--select STU", "STU002"),
        ('ignore = ["STU001"]', "--select STU001", "STU001"),
        ('ignore = ["stu001"]', "--select stu001", "STU001"),
        ('ignore = ["STU"]', "--select STU001", "STU001"),
        ('ignore = ["STU001"]', "--select STU --ignore STU002", ""),
    ],
)
def test_selection(
    file: str, arguments: str, on: str, tool: Callable[..., Ran], tmp_path: Path
) -> None:
    """The longest selector wins, then the command line, then what is ignored."""
    (tmp_path / "usdvol-lint.toml").write_text(file, encoding="utf-8")
    ran = tool("--show-settings", "--pack", STUDIO, *arguments.split())
    rules = settings(ran)["rules"]
    assert {"LNT001", "LNT002"} <= rules.keys()
    assert " ".join(code for code in rules if code.startswith("STU")) == on


@pytest.mark.parametrize(
    ("file", "arguments", "levels"),
    [
        ("", "", "error warning"),
        ("", "--severity STU=info", "info info"),
        ("", "--severity STU001=warning --severity STU=info", "warning info"),
        ("", "--severity STU=info,stu001=warning", "warning info"),
        ("", "--severity ALL=info --severity S=warning", "warning warning"),
        ('severity = { STU = "info" }', "", "info info"),
        ('severity = { STU001 = "info", STU = "error" }', "", "info error"),
        ('severity = { stu = "info" }', "--severity STU=error", "error error"),
        ('severity = { STU001 = "info" }', "--severity STU=error", "info error"),
    ],
)
def test_severity(
    file: str, arguments: str, levels: str, tool: Callable[..., Ran], tmp_path: Path
) -> None:
    (tmp_path / "usdvol-lint.toml").write_text(file, encoding="utf-8")
    ran = tool("--show-settings", "--pack", STUDIO, "--select", "STU", *arguments.split())
    rules = settings(ran)["rules"]
    assert f"{rules['STU001']} {rules['STU002']}" == levels
    assert rules["LNT001"] == "error"


@pytest.mark.parametrize(
    ("arguments", "code"),
    [
        ("smoke.usda", 0),
        ("fog.usda", 1),
        ("fog.usda --fail-on never", 0),
        ("fog.usda --severity STU=warning", 0),
        ("fog.usda --severity STU=warning --fail-on warning", 1),
        ("fog.usda --severity STU=info --fail-on warning", 0),
        ("fog.usda --severity STU=info --fail-on info", 1),
        ("fog.usda smoke.usda gone.usda --fail-on never", 2),
    ],
)
def test_exit_code(arguments: str, code: int, tmp_path: Path) -> None:
    write(tmp_path, fog=volume("fog"), smoke=volume("smoke"))
    ran = run(*ONLY_STUDIO, "--ignore", "STU002", *arguments.split(), cwd=tmp_path)
    assert (ran.code, ran.err) == (code, "")


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ("--select STU01x .", "no rule code starts with 'STU01x'; did you mean 'STU001'?"),
        (
            "--ignore volume-name .",
            "no rule code starts with 'volume-name'; did you mean 'STU001'?",
        ),
        ("--ignore xyzzy .", "no rule code starts with 'xyzzy'"),
        ("--ignore LNT001 .", "LNT001 can't be ignored: it says that the job was not done"),
        (
            "--severity STU001 .",
            "--severity STU001: write it as CODE=LEVEL, such as AST002=warning",
        ),
        (
            "--severity STU001=eror .",
            "--severity STU001 must be one of error, warning, info, not 'eror'; "
            "did you mean 'error'?",
        ),
        ("--severity STV001=info .", "no rule code starts with 'STV001'; did you mean 'STU001'?"),
        ("--severity LNT002=info .", "LNT002 stays an error: it says that the job was not done"),
        (
            "--fail-on warn .",
            "--fail-on must be one of error, warning, info, never, not 'warn'; "
            "did you mean 'warning'?",
        ),
        ("--load some .", "--load must be one of all, none, not 'some'"),
        ("--variants any .", "--variants must be one of selected, all, not 'any'"),
        (
            "--timeout 0 .",
            "--timeout must be a number of seconds above 0, at most 1,000,000, not 0.0",
        ),
        (
            "--timeout nan .",
            "--timeout must be a number of seconds above 0, at most 1,000,000, not nan",
        ),
        ("--output-format json --output . .", "--output .: this is a folder, name a file"),
        (
            "--output-format json --output gone/x.json .",
            "--output gone/x.json: there is no folder gone",
        ),
        ("--output a --output b .", "2 times --output, but 1 times --output-format"),
        (
            "--output-format json --output-format full .",
            "only one report can go to standard output: give the others an --output",
        ),
        (
            "--output-format json --output a --output-format full --output ./a .",
            "one file can't take several reports: name each --output once",
        ),
        ("--pack gone .", "rule pack 'gone': no such folder"),
    ],
)
def test_mistakes_on_the_command_line(
    arguments: str, said: str, tool: Callable[..., Ran], tmp_path: Path
) -> None:
    write(tmp_path, smoke=volume("smoke"))
    ran = tool("--isolated", "--pack", STUDIO, *arguments.split())
    assert ran == Ran(2, "", f"usdvol-lint: error: {said}\n")
    assert os.listdir(tmp_path) == ["smoke.usda"]


def test_an_unknown_format_names_the_nearest(tool: Callable[..., Ran]) -> None:
    ran = tool("--isolated", "--output-format", "jsn", ".")
    assert (ran.code, ran.out) == (2, "")
    assert ran.err.startswith("usdvol-lint: error: --output-format must be one of full, concise, ")
    assert ran.err.endswith("not 'jsn'; did you mean 'json'?\n")


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ("--verbos .", "No such option"),
        ("--jobs 0 .", "Invalid value for '--jobs'"),
        ("--jobs many .", "Invalid value for '--jobs'"),
        ("--timeout soon .", "Invalid value for '--timeout'"),
        ("--color red .", "Invalid value for '--color'"),
        ("--select", "Option '--select' requires an argument"),
        ("--isolated --config x.toml .", "--config and --isolated exclude each other"),
    ],
)
def test_usage_errors(arguments: str, said: str, tool: Callable[..., Ran]) -> None:
    ran = tool(*arguments.split())
    assert (ran.code, ran.out) == (2, "")
    assert said in ran.err


def test_what_goes_wrong_in_the_tool_itself_is_no_finding(
    tool: Callable[..., Ran], monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*arguments: object) -> None:
        raise RuntimeError("two\nlines")

    monkeypatch.setattr(cli, "_lint", fail)
    said = "usdvol-lint: internal error: RuntimeError: two lines (--verbose shows more)\n"
    assert tool(".") == Ran(2, "", said)


# --- configuration files --------------------------------------------------------------------------


def test_every_setting_has_a_check() -> None:
    assert tuple(key.replace("-", "_") for key in CHECKS) == Config._fields


def test_the_nearest_configuration_counts(tool: Callable[..., Ran], tmp_path: Path) -> None:
    shot = tmp_path / "show" / "shot"
    shot.mkdir(parents=True)
    os.chdir(shot)
    assert settings(tool("--show-settings"))["config_file"] is None

    outer = tmp_path / "pyproject.toml"
    outer.write_text('[tool.usdvol-lint]\nfail-on = "info"\n', encoding="utf-8")
    (tmp_path / "show" / "pyproject.toml").write_text("[tool.other]\nx = 1\n", encoding="utf-8")
    found = settings(tool("--show-settings"))
    assert (found["config_file"], found["fail_on"]) == (str(outer), "info")

    own = tmp_path / "show" / "usdvol-lint.toml"
    own.write_text('fail-on = "never"\n', encoding="utf-8")
    found = settings(tool("--show-settings"))
    assert (found["config_file"], found["fail_on"]) == (str(own), "never")

    found = settings(tool("--show-settings", "--fail-on", "warning"))
    assert (found["config_file"], found["fail_on"]) == (str(own), "warning")
    found = settings(tool("--show-settings", "--isolated"))
    assert (found["config_file"], found["fail_on"]) == (None, "error")
    found = settings(tool("--show-settings", "--config", "../../pyproject.toml"))
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
        "load": "none",
        "variants": "all",
        "variant_limit": 7,
        "timeout": 12.0,
    }
    shown = settings(tool("--show-settings"))
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
        ("ignore = ['AST', 3]", "ignore must be a list of strings, not ['AST', 3]"),
        ("packs = true", "packs must be a list of strings, not True"),
        ("severity = 'error'", "severity must be a table, not 'error'"),
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
        ("timeout = 0", "timeout must be a number of seconds above 0, at most 1,000,000, not 0"),
        (
            "timeout = inf",
            "timeout must be a number of seconds above 0, at most 1,000,000, not inf",
        ),
        (
            "timeout = '9'",
            "timeout must be a number of seconds above 0, at most 1,000,000, not '9'",
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


def test_a_project_without_our_table(tool: Callable[..., Ran], tmp_path: Path) -> None:
    (tmp_path / "pyproject.toml").write_text("tool = 3\n", encoding="utf-8")
    assert settings(tool("--show-settings"))["config_file"] is None
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
    ran = run(".", cwd=tmp_path)
    said = "mist.usda:2:1: STU001 warning </mist> name 'mist', wanted fog\n"
    assert ran == Ran(1, said, "")


# --- streams and files ----------------------------------------------------------------------------

TEXT_REPORT = f"""\
fog.usda
  /fog
    STU001 error: {WRONG}
      --> fog.usda:2:1
"""
VERDICT = re.compile(r"1 error in 1 of 2 stages; 2 volumes checked in [\d.]+ s\n")


@pytest.fixture
def two(tmp_path: Path) -> Path:
    return write(tmp_path, fog=volume("fog"), smoke=volume("smoke"))


def test_the_report_goes_to_standard_output(two: Path) -> None:
    ran = run(*ONLY_STUDIO, "--ignore", "STU002", ".", cwd=two)
    report, _, verdict = ran.out.rpartition("\n\n")
    assert (ran.code, ran.err, f"{report}\n") == (1, "", TEXT_REPORT)
    assert VERDICT.fullmatch(verdict)


def test_quiet_and_verbose(two: Path) -> None:
    only = (*ONLY_STUDIO, "--ignore", "STU002")
    assert run(*only, "--quiet", "smoke.usda", cwd=two) == Ran(0, "", "")
    assert run(*only, "-q", ".", cwd=two) == Ran(1, TEXT_REPORT, "")
    ran = run(*only, "--verbose", "smoke.usda", cwd=two)
    assert (ran.code, ran.err) == (0, "")
    assert re.search(r"^  stats: prims 1, volumes 1, ", ran.out, re.MULTILINE)
    assert re.search(r"^  seconds: open [\d.]+, walk [\d.]+, check ", ran.out, re.MULTILINE)


def test_several_reports_in_one_run(two: Path) -> None:
    ran = run(
        *(*ONLY_STUDIO, "--ignore", "STU002"),
        *("--output-format", "json", "--output", "report.json"),
        *("--output-format", "concise", "--output", "report.txt"),
        *("--output-format", "full", "."),
        cwd=two,
    )
    assert (ran.code, ran.err, ran.out.partition("\n\n")[0] + "\n") == (1, "", TEXT_REPORT)
    assert (two / "report.txt").read_text() == f"fog.usda:2:1: STU001 error </fog> {WRONG}\n"
    found = json.loads((two / "report.json").read_text())["summary"]["by_code"]
    assert found == {"STU001": 1}
    assert sorted(os.listdir(two)) == ["fog.usda", "report.json", "report.txt", "smoke.usda"]


def test_the_terminal_has_a_report_beside_files_for_machines(two: Path) -> None:
    only = (*ONLY_STUDIO, "--ignore", "STU002", "--quiet")
    ran = run(*only, "--output-format", "json", "--output", "report.json", ".", cwd=two)
    assert ran == Ran(1, TEXT_REPORT, "")
    ran = run(*only, "--output", "report.txt", ".", cwd=two)
    assert ran == Ran(1, "", "")
    assert (two / "report.txt").read_text().startswith(f"{TEXT_REPORT}\n1 error in 1 of 2 stages;")


def test_a_report_replaces_the_old_one_whole(two: Path) -> None:
    (two / "real.json").write_text("old and longer than the new one" * 1000)
    (two / "report.json").symlink_to("real.json")
    ran = run(
        *(*ONLY_STUDIO, "--quiet", "--output-format", "json"),
        *("--output", "report.json", "fog.usda"),
        cwd=two,
    )
    assert (ran.code, ran.err) == (1, "")
    assert (two / "report.json").is_symlink()
    assert json.loads((two / "real.json").read_text())["summary"]["errors"] == 1


def test_a_file_that_can_not_be_written_loses_nothing(two: Path) -> None:
    """The folder goes while the run is under way: the check before the work could not know."""
    pack = write(two / "pack")
    (pack / "remover.py").write_text(
        "import shutil\n"
        "from usdvol_lint.rule import INFO, STAGE, rule\n"
        "@rule('RMV001', on=STAGE, severity=INFO, since='1')\n"
        "def remover(stage, facts):\n"
        "    shutil.rmtree('out', ignore_errors=True)\n"
        "    yield from ()\n"
    )
    (two / "out").mkdir()
    ran = run(
        *("--isolated", "--pack", "pack", "--pack", STUDIO, "--select", "STU001,RMV", "--quiet"),
        *("--output-format", "json", "--output", "out/report.json"),
        *("--output-format", "concise", "--output", "report.txt", "fog.usda"),
        cwd=two,
    )
    assert ran.code == 2
    assert re.fullmatch(r"usdvol-lint: error: --output out[/\\]report.json: .+\n", ran.err)
    assert json.loads(ran.out)["summary"]["by_code"] == {"STU001": 1}
    assert (two / "report.txt").read_text() == f"fog.usda:2:1: STU001 error </fog> {WRONG}\n"


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs /dev/full and /dev/null")
def test_devices(two: Path) -> None:
    only = (*ONLY_STUDIO, "--ignore", "STU002", "--quiet", "fog.usda")
    ran = run(*only, "--output-format", "json", "--output", os.devnull, cwd=two)
    assert ran == Ran(1, TEXT_REPORT, "")
    assert not os.path.isfile(os.devnull)
    ran = run(*only, "--output", "/dev/full", cwd=two)
    said = "usdvol-lint: error: --output /dev/full: No space left on device\n"
    assert (ran.code, ran.err) == (2, said)
    assert ran.out.startswith(f"{TEXT_REPORT}\n1 error in 1 stage;")
    with open("/dev/full", "w") as full:
        done = subprocess.run(
            [
                *PROGRAM,
                *only,
                "--output-format",
                "json",
                "--output",
                "x",
                "--output-format",
                "full",
            ],
            cwd=two,
            env=environment(),
            stdout=full,
            stderr=subprocess.PIPE,
            check=False,
        )
    assert done.returncode == 2
    said = b"usdvol-lint: error: can't write to standard output: No space left on device\n"
    assert done.stderr == said
    assert json.loads((two / "x").read_text())["summary"]["errors"] == 1


@pytest.mark.parametrize(
    ("arguments", "code"),
    [([*map(str, ONLY_STUDIO), "."], 1), (["--list-rules"], 0), (["--help"], 2)],
)
def test_the_reader_may_leave(arguments: list[str], code: int, two: Path) -> None:
    """As `head -1` does."""
    with subprocess.Popen(
        [*PROGRAM, *arguments],
        cwd=two,
        env=environment(),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    ) as process:
        assert process.stdout
        assert process.stderr
        process.stdout.close()
        assert process.stderr.read() == b""
    assert process.returncode == code


@pytest.mark.skipif(os.name != "posix", reason="needs a POSIX shell")
@pytest.mark.parametrize("output", ["", "--output-format json --output report.json"])
def test_without_standard_output(output: str, two: Path) -> None:
    arguments = [*PROGRAM, *map(str, ONLY_STUDIO), ".", *output.split()]
    done = subprocess.run(
        ["/bin/sh", "-c", 'exec "$@" >&-', "sh", *arguments],
        cwd=two,
        env=environment(),
        stderr=subprocess.PIPE,
        check=False,
    )
    said = b"usdvol-lint: error: there is no standard output to print to\n"
    assert (done.returncode, done.stderr) == (2, said)
    assert (two / "report.json").is_file() == bool(output)


@pytest.mark.parametrize(
    ("arguments", "variables", "coloured"),
    [
        ("", {}, False),
        ("", {"FORCE_COLOR": "1"}, True),
        ("", {"FORCE_COLOR": "1", "NO_COLOR": "1"}, False),
        ("--color always", {"NO_COLOR": "1"}, True),
        ("--color never", {"FORCE_COLOR": "1"}, False),
        ("--output-format concise", {"FORCE_COLOR": "1"}, True),
        ("--output-format json --color always", {"FORCE_COLOR": "1"}, False),
        ("--output report.txt --color always", {}, False),
    ],
)
def test_colour(arguments: str, variables: dict[str, str], coloured: bool, two: Path) -> None:
    env = environment(**variables)
    ran = run(*ONLY_STUDIO, *arguments.split(), "fog.usda", cwd=two, env=env)
    assert (ran.code, ran.err) == (1, "")
    assert ("\x1b[" in ran.out) == coloured
    if (two / "report.txt").exists():
        assert "\x1b" not in (two / "report.txt").read_text()


@pytest.mark.skipif(os.name != "posix", reason="such file names are for POSIX only")
@pytest.mark.parametrize("format", sorted(FORMATS))
def test_foreign_text_is_harmless(format: str, tmp_path: Path) -> None:
    """Escape sequences and markup in names, in paths and in what USD quotes of a broken layer."""
    name = "[bold]\x1b[31m\u202e[bold]\r\n::error::.usda"
    text = '#usda 1.0\ndef OpenVDBAsset "a"\n{\n    asset filePath = @./[red]\u202e[/x].vdb@\n}\n'
    (tmp_path / name).write_text(text, encoding="utf-8")
    (tmp_path / "broken.usda").write_text("#usda 1.0\n\x1b[31m[red]\n", encoding="utf-8")
    (tmp_path / "garbage.usda").write_text("\x1b[31m[red]\n", encoding="utf-8")
    os.mkdir(tmp_path / "undecodable")
    (tmp_path / os.fsdecode(b"undecodable/\xff\xfe.usda")).write_text(volume("fog"))
    select = ("--isolated", "--select", "AST002", "--output-format", format)
    for color in ("never", "always"):
        ran = run(*select, "--color", color, ".", cwd=tmp_path)
        assert (ran.code, ran.err) == (2, "")
        plain = re.sub(r"\x1b\[[\d;]*m", "", ran.out) if color == "always" else ran.out
        assert "[red]" in plain
        assert "[/x].vdb" in plain
        assert not re.search(r"[\x00-\x09\x0b-\x1f\x7f-\x9f\u202e]", plain), repr(plain)
        if format == "json":
            assert {stage["path"] for stage in ran.json["stages"]} >= {name, "broken.usda"}
        else:
            assert not re.search(r"^::", plain, re.MULTILINE)


# --- processes ------------------------------------------------------------------------------------


def test_the_parent_imports_neither_usd_nor_numpy(two: Path) -> None:
    done = subprocess.run(
        [PROGRAM[0], "-X", "importtime", *PROGRAM[1:], *map(str, ONLY_STUDIO), "."],
        cwd=two,
        env=environment(),
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 1
    imported = {line.rpartition("|")[2].strip() for line in done.stderr.splitlines()}
    assert {"usdvol_lint.run.pool", "usdvol_lint.report.style"} <= imported
    roots = {name.partition(".")[0] for name in imported}
    assert roots.isdisjoint({"pxr", "numpy", "rich"})


def test_the_same_bytes_for_any_number_of_jobs(tmp_path: Path) -> None:
    folder = tmp_path / "stages"
    names = ["smoke", "fog", "fire", "mist", "steam", "cloud", "dust", "haze"]
    write(folder, **{name: volume(name) for name in names})
    write(folder / "below", abort=volume("abort"), raising=volume("raise"), more=volume("smoke"))
    (folder / "garbage.usda").write_text("garbage")
    (folder / "empty.usdc").write_bytes(b"")
    (folder / "cut.usda").write_text('#usda 1.0\ndef Volume "cut"\n{\n')
    arguments = ("--isolated", "--pack", STUDIO, "--pack", ROUGH, "--select", "STU,RGH")
    outputs = set()
    for jobs in ("1", "1", "2", "4"):
        ran = run(*arguments, "-j", jobs, "--output-format", "json", "stages", cwd=tmp_path)
        assert (ran.code, ran.err) == (2, "")
        outputs.add(re.sub(r'"seconds": [\d.e-]+', '"seconds": 0', ran.out))
    (output,) = outputs
    summary = json.loads(output)["summary"]
    assert summary["by_status"] == {"checked": 10, "crashed": 1, "unreadable": 3}
    assert summary["by_code"] == {
        "LNT001": 4, "LNT002": 1, "RGH001": 9, "STU001": 7, "STU002": 10,
    }  # fmt: skip


def test_each_stage_once_in_the_order_given(two: Path) -> None:
    write(two / "b" / "deep", one=volume("fog"))
    write(two / "a", two=volume("fog"))
    write(two / ".hidden", no=volume("fog"))
    (two / "notes.txt").write_text("not a stage, and not named")
    ran = run(
        *ONLY_STUDIO,
        *("--output-format", "json", "smoke.usda", "b", ".", "./fog.usda", two / "a"),
        cwd=two,
    )
    assert [stage["path"] for stage in ran.json["stages"]] == [
        "smoke.usda",
        "b/deep/one.usda",
        "a/two.usda",
        "fog.usda",
    ]


@pytest.mark.skipif(os.name != "posix", reason="signals as POSIX has them")
@pytest.mark.parametrize("end", ["ctrl-c", "terminate"])
def test_interrupted(end: str, tmp_path: Path) -> None:
    """No process stays behind, not even one that hangs."""
    write(tmp_path, hang=volume("hang"))
    # Under `make test &` and nohup it would be ignored, and inherited as ignored.
    previous = signal.signal(signal.SIGINT, signal.default_int_handler)
    with subprocess.Popen(
        [*PROGRAM, "--isolated", "--pack", str(ROUGH), "hang.usda"],
        cwd=tmp_path,
        env=environment(),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        start_new_session=True,
    ) as process:
        deadline = time.monotonic() + 60
        while not (tmp_path / "hanging").exists():
            assert time.monotonic() < deadline
            assert process.poll() is None
            time.sleep(0.02)
        if end == "ctrl-c":  # the terminal tells the whole group
            os.killpg(process.pid, signal.SIGINT)
        else:
            process.terminate()
        out, err = process.communicate(timeout=60)
    signal.signal(signal.SIGINT, previous)
    assert (process.returncode, out, err.strip()) == (2, b"", b"usdvol-lint: interrupted")
    with pytest.raises(ProcessLookupError):
        os.killpg(process.pid, 0)


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere nobody stands in a removed folder")
def test_the_working_directory_is_gone(tmp_path: Path) -> None:
    write(tmp_path, smoke=volume("smoke"))
    gone = tmp_path / "gone"
    gone.mkdir()
    done = subprocess.run(
        ["/bin/sh", "-c", 'rmdir "$0"; exec "$@"', gone, *PROGRAM, tmp_path / "smoke.usda"],
        cwd=gone,
        env=environment(),
        capture_output=True,
        text=True,
        check=False,
    )
    said = "usdvol-lint: error: the working directory is not there any more\n"
    assert (done.returncode, done.stdout, done.stderr) == (2, "", said)
