"""What the tool says of itself: its help, its rules and their pages, completion."""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from process import STUDIO, Ran, environment, run

from usdvol_lint import __version__
from usdvol_lint.command import cli
from usdvol_lint.config import OUTPUT_FORMATS
from usdvol_lint.packs.catalog import load
from usdvol_lint.report import FORMATS


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
    assert ("auto", *FORMATS) == OUTPUT_FORMATS
    words = cli.command.get_help(cli.click.Context(cli.command))
    assert all(re.search(rf"\b{name}\b", words) for name in FORMATS)
