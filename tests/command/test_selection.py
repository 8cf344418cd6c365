"""Which rules are in force at which severity, the exit code, and mistakes on the command line."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest
from process import AS_JSON, ONLY_STUDIO, STUDIO, Ran, run, settings, volume, write

from usdvol_lint.command import linting

NONE = "is no rule, no family and no beginning of a code"
EMPTY = (
    "has an empty value: if a script brings it, its variable is not set; "
    "leave the option out to say nothing"
)
MAY_BE_EMPTY = ("--select", "--ignore", "--severity", "--pack")


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
        # By names of rules and families, which are as exact as codes and the letters of codes.
        ("", "--select house", "STU001 STU002"),
        ("", "--select Volume-Name", "STU001"),
        ("", "--select house --ignore volume-name", "STU002"),
        ("", "--select volume-name --ignore STU", "STU001"),
        ("", "--select STU001 --ignore house", "STU001"),
        ("", "--select house --ignore STU", ""),
        ("", "--select STU00 --ignore house", "STU001 STU002"),
        ("", "--select volume-name --ignore STU001", ""),
        ('ignore = ["volume-name"]', "--select STU001", "STU001"),
        ('ignore = ["house"]', "--select STU", "STU001 STU002"),
        # Nothing is not the same as nothing said.
        ("select = []", "", ""),
        ("select = []", "--select STU002", "STU002"),
        ("select = []\nignore = []", "--ignore STU", ""),
    ],
)
def test_selection(
    file: str, arguments: str, on: str, tool: Callable[..., Ran], tmp_path: Path
) -> None:
    """The most exact selector wins, then the command line, then what is ignored."""
    (tmp_path / "usdvol-lint.toml").write_text(file, encoding="utf-8")
    ran = tool(*AS_JSON, "--pack", STUDIO, *arguments.split())
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
        ('severity = { volume-name = "info" }', "--severity house=error", "info error"),
        ('severity = { volume-name = "info" }', "--severity STU001=error", "error warning"),
        ('severity = { STU001 = "info", volume-seen = "info" }', "", "info info"),
        ('severity = { volume-name = "info", STU001 = "warning" }', "", "warning warning"),
    ],
)
def test_severity(
    file: str, arguments: str, levels: str, tool: Callable[..., Ran], tmp_path: Path
) -> None:
    (tmp_path / "usdvol-lint.toml").write_text(file, encoding="utf-8")
    ran = tool(*AS_JSON, "--pack", STUDIO, "--select", "STU", *arguments.split())
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
        ("fog.usda smoke.usda garbage.usda --fail-on never", 2),
    ],
)
def test_exit_code(arguments: str, code: int, tmp_path: Path) -> None:
    write(tmp_path, fog=volume("fog"), smoke=volume("smoke"), garbage="garbage")
    ran = run(*ONLY_STUDIO, "--ignore", "STU002", *arguments.split(), cwd=tmp_path)
    assert (ran.code, ran.err) == (code, "")


@pytest.mark.parametrize(
    ("file", "arguments", "is_shown"),
    [
        ("", "", False),
        ("", "--fail-on never", False),
        ("", "--fail-on warning", False),
        ("", "--fail-on info", True),
        ("", "--show info", True),
        ("", "--show info --show info --quiet", True),
        ("", "--quiet", False),
        ("", "--verbose", True),
        ('show = ["info"]', "", True),
        ('fail-on = "info"', "", True),
        ('fail-on = "info"', "--fail-on error", False),
    ],
)
def test_infos_are_shown_to_those_who_ask(
    file: str, arguments: str, is_shown: bool, tmp_path: Path
) -> None:
    """On standard output as in files; else a line counts them, which --quiet leaves out too."""
    write(tmp_path, fog=volume("fog"))
    (tmp_path / "usdvol-lint.toml").write_text(file, encoding="utf-8")
    studio = ("--pack", STUDIO, "--select", "STU001", "--severity", "STU=info")
    report = ("--output-format", "concise", "--output", "report.txt", "--output-format", "full")
    ran = run(*studio, *arguments.split(), *report, "fog.usda", cwd=tmp_path)
    assert ("STU001" in ran.out) == is_shown
    assert ("STU001" in (tmp_path / "report.txt").read_text(encoding="utf-8")) == is_shown
    assert ("1 info, shown with --show info" in ran.out) == (
        not is_shown and "--quiet" not in arguments
    )
    assert is_shown or "--quiet" not in arguments or ran.out == ""


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (
            "--show infos .",
            "--show must be one of info, known, suppressed, unused, not 'infos'; "
            "did you mean 'info'?",
        ),
        (
            "--show info --show xyzzy .",
            "--show must be one of info, known, suppressed, unused, not 'xyzzy'",
        ),
        ("--select STU01x .", f"--select: 'STU01x' {NONE}; did you mean 'STU001'?"),
        ("--ignore volum-name .", f"--ignore: 'volum-name' {NONE}; did you mean 'volume-name'?"),
        ("--ignore hous .", f"--ignore: 'hous' {NONE}; did you mean 'house'?"),
        ("--ignore xyzzy .", f"--ignore: 'xyzzy' {NONE}"),
        (
            "--ignore LNT001 .",
            "--ignore: LNT001 can't be ignored: it says that the job was not done",
        ),
        (
            "--ignore rule-failed .",
            "--ignore: rule-failed can't be ignored: it says that the job was not done",
        ),
        *((f"{option}= .", f"{option} {EMPTY}") for option in MAY_BE_EMPTY),
        ("--select STU --select , .", f"--select {EMPTY}"),
        (
            "--severity STU001 .",
            "--severity STU001: write it as CODE=LEVEL, such as AST002=warning",
        ),
        (
            "--severity STU001=eror .",
            "--severity STU001 must be one of error, warning, info, not 'eror'; "
            "did you mean 'error'?",
        ),
        (
            "--severity STV001=info .",
            f"--severity STV001: 'STV001' {NONE}; did you mean 'STU001'?",
        ),
        (
            "--severity LNT002=info .",
            "--severity LNT002: LNT002 stays an error: it says that the job was not done",
        ),
        (
            "--severity STU001=off .",
            "--severity STU001 must be one of error, warning, info, not 'off'; "
            "a rule that is to report nothing stands in `ignore`",
        ),
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
        ("--output-format json --output r/ .", "--output r/: this is a folder, name a file"),
        (
            "--output-format json --output gone/x.json .",
            "--output gone/x.json: there is no folder gone",
        ),
        (
            "--output a --output b .",
            "--output is given twice, --output-format never: name a format for each file, "
            "before it",
        ),
        (
            "--output-format json --output-format full .",
            "only one report can go to standard output: give the others an --output",
        ),
        (
            "--output-format json --output a --output-format full --output ./a .",
            "one file can't take several reports: name each --output once",
        ),
        ("--pack gone .", "--pack: there is no folder 'gone', which is to be a rule pack"),
        ("--root gone .", "--root: the root 'gone' is no folder"),
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
    assert ran.err.startswith("usdvol-lint: error: --output-format must be one of auto, full, ")
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

    monkeypatch.setattr(linting, "lint_stages", fail)
    said = "usdvol-lint: internal error: RuntimeError: two lines (--verbose shows more)\n"
    assert tool(".") == Ran(2, "", said)


@pytest.mark.parametrize(("file", "arguments"), [("select = []", ""), ("", "--ignore ALL")])
def test_a_run_without_rules_says_so(
    file: str, arguments: str, tool: Callable[..., Ran], tmp_path: Path
) -> None:
    (tmp_path / "usdvol-lint.toml").write_text(file, encoding="utf-8")
    write(tmp_path, fog=volume("fog"))
    ran = tool(*arguments.split(), "fog.usda")
    said = (
        "usdvol-lint: no rule is on, as `select` and `ignore` say: only what can't be read is told"
    )
    assert (ran.code, ran.err) == (0, f"{said}\n")
    assert tool(*arguments.split(), "--quiet", "fog.usda").err == ""
    assert tool("--select", "STG003", "fog.usda").err == ""
