"""No text of a stranger's is more than text, in whatever is printed of it."""

from __future__ import annotations

import json
import re
import tomllib
from collections.abc import Callable
from pathlib import Path

import pytest
from process import Ran, run

from usdvol_lint.report import FORMATS

HOSTILE = (
    "\x1b]0;title\x07\x1b[31m\u202e\r\n::error::x\n##[error]y ##vso[task.setvariable]z \x9b31m\x7f"
    " <script>alert(1)</script> [a](javascript:x) ]]> &lt; `code`"
)
"""What terminals, GitHub, Azure, HTML, Markdown and XML would take for their own."""
TAKEN = re.compile("[\x00-\x09\x0b-\x1f\x7f-\x9f\u202e]|##\\[|##vso\\[|^::", re.MULTILINE)
OPTIONS = (
    *("--select", "--ignore", "--severity", "--fail-on", "--output-format", "--output", "--show"),
    *("--summary", "--color", "--exclude", "--files-from", "--changed-since", "--frames"),
    *("--search-path", "--config", "--pack", "--load", "--times", "--baseline", "--root", "--jobs"),
    *("--write-baseline", "--moved", "--today", "--timeout", "--explain", "--test"),
)
QUOTED = json.dumps(HOSTILE).replace("\x7f", "\\u007f")
"""The same as a text of TOML."""
CONFIGURATIONS = (
    *("{0} = 1", "[{0}]", "select = [{0}]", "severity = {{ {0} = 'error' }}", "extend = {0}"),
    *("options.{0} = {{}}", "options.AST002 = {{ {0} = 1 }}", "packs = [{0}]", "fail-on = {0}"),
    *("root = {0}", "baseline = {0}", "version-pattern = {0}", "frames = {0}", "today = {0}"),
    *("exclude = [{0}]", "assume-present = [{0}]", "search-path = [{0}]", "jobs = {0}"),
    *("path-map = {{ {0} = {0} }}", "required-version = {0}", "rules-as-of = {0}"),
    "[[suppress]]\nfiles = {0}\nreason = {0}\nuntil = 2020-01-01",
    "[[per-path]]\nfiles = {0}\nignore = [{0}]",
)


def check(ran: Ran) -> None:
    said = ran.out + ran.err
    assert said
    assert not TAKEN.search(said), repr(said)


@pytest.mark.parametrize("option", OPTIONS)
def test_what_an_option_is_given(option: str, tool: Callable[..., Ran], tmp_path: Path) -> None:
    check(tool("--isolated", option, HOSTILE, "gone.usda"))


def test_what_is_no_option_and_no_stage(tool: Callable[..., Ran]) -> None:
    for argument in (HOSTILE, f"--{HOSTILE}", f"-{HOSTILE}"):
        check(tool("--isolated", argument))
        check(tool("--isolated", "--show-files", argument))


@pytest.mark.parametrize("text", CONFIGURATIONS)
def test_what_a_configuration_says(text: str, tool: Callable[..., Ran], tmp_path: Path) -> None:
    """Also where the settings are printed, as a file and for programs."""
    (tmp_path / "usdvol-lint.toml").write_text(text.format(QUOTED), encoding="utf-8")
    shown = tool("--show-settings")
    check(shown)
    check(tool("--show-settings", "--output-format", "json"))
    if not shown.code:
        assert tomllib.loads(shown.out)


def test_what_its_parser_quotes(tool: Callable[..., Ran], tmp_path: Path) -> None:
    (tmp_path / "usdvol-lint.toml").write_text(f"x = {HOSTILE}", encoding="utf-8")
    check(tool("--show-settings"))


STAGE = """\
#usda 1.0
(
    customLayerData = {{ dictionary usdvolLint = {{ string {0} = {0} }} }}
    upAxis = {0}
)
def Volume "v" (
    customData = {{ dictionary usdvolLint = {{ dictionary ignore = {{ string {0} = {0} }} }} }}
    displayName = {0}
)
{{
    rel field:d = </v/d>
    def OpenVDBAsset "d" (
        customData = {{ dictionary usdvolLint = {{ dictionary ignore = {{ string AST = {0} }} }} }}
    )
    {{
        asset filePath = @./\u202e##[error]y<script>]]>`code`.vdb@
        token fieldName = {0}
        token fieldDataType = {0}
        token vectorDataRoleHint = {0}
    }}
}}
"""


def test_what_a_stage_says(tmp_path: Path) -> None:
    """In every format, with all that can be shown; an annotation is GitHub's, and of ours alone."""
    text = HOSTILE.replace("\x9b", "")
    for char in "\x1b\x07\x7f":
        text = text.replace(char, f"\\x{ord(char):02x}")
    text = text.replace("\r", "\\r").replace("\n", "\\n")
    (tmp_path / "a.usda").write_text(STAGE.format(f'"{text}"'), encoding="utf-8")
    shown = [word for what in ("info", "suppressed", "unused") for word in ("--show", what)]
    files = [word for name in FORMATS for word in (f"--output-format={name}", f"--output={name}")]
    run("--isolated", "-v", *shown, *files, "a.usda", cwd=tmp_path)
    for name in FORMATS:
        said = (tmp_path / name).read_text(encoding="utf-8")
        assert "LNT003" in said or name == "github", name
        found = TAKEN.findall(said)
        assert set(found) <= ({"::"} if name == "github" else set()), name
        assert len(found) == (len(said.splitlines()) if name == "github" else 0)
