"""What `--show-settings` prints is a configuration file, and says what was in force."""

from __future__ import annotations

import math
import os
import shutil
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from process import AS_JSON, STUDIO, Ran, settings

from usdvol_lint.config import Config
from usdvol_lint.config.layers import laid_over
from usdvol_lint.config.values import CHECKS
from usdvol_lint.config.writing import as_toml
from usdvol_lint.model import UsageError

EVERY_KEY = f"""
select = ["STU", "asset"]
ignore = ["STU002", "file-missing"]
packs = ['{STUDIO}']
fail-on = "warning"
fail-on-unchecked = false
output-format = "concise"
show = ["info", "known"]
jobs = 2
timeout = 12.5
load = "none"
content = "first"
variants = "all"
variant-limit = 7
times = 3
statistics = true
max-places = 5
root = "."
version-pattern = 'v\\d+"'
baseline = "known.jsonl"
required-version = ">=0.0.1,<99"
rules-as-of = "0.1"
suppressions = "configuration"
today = 2026-12-31
exclude = ["archive/", "!archive/kept.usda"]
stages = ["**/shot.usda"]
frames = "1001-1100.5"
search-path = ["here"]
assume-present = ["/mnt/show/**"]
path-map = {{ "P:/" = "/mnt/show/" }}
severity = {{ STU001 = "info", volume-name = "warning", STU = "error" }}
options.volume-name = {{ allowed = ["fög", 'a"\\b'], share = inf, strict = true, longest = 3 }}
options.STU001.prefix = "\\u0000\\u007f\\u202e"

[[suppress]]
files = ["old/**"]
rules = "AST"
reason = "an archive\\nof two lines"
until = 2026-12-31

[[per-path]]
files = "lookdev/**"
severity = {{ "AST" = "info" }}
ignore = ["VOL"]
"""


def test_every_key_comes_back(tool: Callable[..., Ran], tmp_path: Path) -> None:
    """Also with the command line on top, and when it is pasted into a file elsewhere."""
    tables = tomllib.loads(EVERY_KEY)
    assert tables.keys() == CHECKS.keys() - {"extend"}
    (tmp_path / "usdvol-lint.toml").write_text(EVERY_KEY, encoding="utf-8")
    named = ("--config", tmp_path / "usdvol-lint.toml")
    more = ("--ignore", "VOL", "--severity", "STU002=info", "--no-baseline", "--pack", "here")
    shutil.copytree(STUDIO, tmp_path / "here", ignore=lambda folder, names: ["volume_seen.py"])
    (tmp_path / "here" / "house" / "volume_name.py").write_text(
        (STUDIO / "house" / "volume_name.py")
        .read_text(encoding="utf-8")
        .replace("STU001", "HER001")
        .replace("def volume_name", "def volume_named"),
        encoding="utf-8",
    )
    for arguments in ((), more):
        was = settings(tool(*AS_JSON, *named, *arguments))
        printed = tool("--show-settings", *named, *arguments)
        assert (printed.code, printed.err) == (0, "")
        (tmp_path / "elsewhere").mkdir(exist_ok=True)
        (tmp_path / "elsewhere" / "usdvol-lint.toml").write_text(printed.out, encoding="utf-8")
        now = settings(tool(*AS_JSON, "--config", "elsewhere/usdvol-lint.toml"))
        for said in (was, now):
            said["packs"] = [os.path.abspath(pack) for pack in said["packs"]]
            said["root"] = os.path.abspath(said["root"])
            said["baseline"] = said["baseline"] and os.path.abspath(said["baseline"])
            del said["config_file"]
        assert now == was


def test_what_was_taken_back_stays_so(tool: Callable[..., Ran], tmp_path: Path) -> None:
    """An `ignore` that the command line overrules is left out: in one file it would win."""
    (tmp_path / "usdvol-lint.toml").write_text("ignore = ['AST002', 'VOL']\n", encoding="utf-8")
    printed = tool("--show-settings", "--select", "file-missing").out
    assert tomllib.loads(printed)["ignore"] == ["VOL"]


@pytest.mark.parametrize("text", ["", "select = []\n"])
def test_nothing_said_is_not_none(text: str, tool: Callable[..., Ran], tmp_path: Path) -> None:
    (tmp_path / "usdvol-lint.toml").write_text(text, encoding="utf-8")
    printed = tool("--show-settings").out
    assert ("select" in tomllib.loads(printed)) == bool(text)


def test_comments_say_where_each_is_said(tool: Callable[..., Ran], tmp_path: Path) -> None:
    (tmp_path / "studio.toml").write_text(
        "jobs = 3\ntimeout = 5\nseverity.AST002 = 'info'\noptions.AST001 = {}\n", encoding="utf-8"
    )
    file = tmp_path / "usdvol-lint.toml"
    file.write_text("extend = 'studio.toml'\njobs = 4\nignore = ['VOL']\n", encoding="utf-8")
    lines = tool("--show-settings", "--ignore", "GRD", "--severity", "AST003=info").out.splitlines()
    studio = tmp_path / "studio.toml"
    assert lines[0] == f"# configuration file: {file}, which extends {studio}"
    assert {
        f"jobs = 4  # {file}",
        f"timeout = 5.0  # {studio}",
        f'ignore = ["VOL", "GRD"]  # {file}, --ignore',
        f'AST002 = "info"  # {studio}',
        'AST003 = "info"  # --severity AST003',
        'load = "all"',
        "# root is not set",
        "# AST002  info     file-missing",
    } <= set(lines)


def test_comments_say_what_patterns_are_relative_to(
    tool: Callable[..., Ran], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A pattern that is pasted elsewhere means something else, so its folder is named."""
    text = "exclude = ['old/', '*.tmp.usda']\nstages = ['shot.usda']\n"
    (tmp_path / "usdvol-lint.toml").write_text(text, encoding="utf-8")
    (tmp_path / "inside").mkdir()
    monkeypatch.chdir(tmp_path / "inside")
    lines = tool("--show-settings", "--exclude", "gone/").out.splitlines()
    assert [line for line in lines if ": relative to " in line] == [
        f'# "old/", "*.tmp.usda" of exclude: relative to {tmp_path}',
        f'# "gone/" of exclude: relative to {tmp_path / "inside"}',
        f'# "shot.usda" of stages: relative to {tmp_path}',
    ]


TEXTS = st.text(st.characters(exclude_categories=["Cs"]))
FILLED = TEXTS.filter(str.strip)
SCALARS = TEXTS | st.booleans() | st.integers() | st.floats() | st.lists(TEXTS)
PATTERNS = st.sampled_from(["a/**", "*.usda", 'b"\\ ', "é"])
TABLES = {
    "severity": st.dictionaries(TEXTS, st.sampled_from(["error", "info"])),
    "options": st.dictionaries(TEXTS, st.dictionaries(TEXTS, SCALARS)),
    "select": st.lists(FILLED),
    "ignore": st.lists(FILLED),
    "version-pattern": st.sampled_from([r"v\d+", "'\"\x00"]),
    "timeout": st.floats(1e-9, 1e6),
    "suppress": st.lists(st.fixed_dictionaries({"files": PATTERNS, "reason": FILLED})),
    "per-path": st.lists(
        st.fixed_dictionaries(
            {"files": PATTERNS, "severity": st.dictionaries(TEXTS, st.just("info"), min_size=1)}
        )
    ),
}


@given(st.fixed_dictionaries({}, optional=TABLES))
def test_any_texts_and_numbers_come_back(values: dict[str, Any]) -> None:
    checked = {key: CHECKS[key](f"f\n.toml: {key}", value) for key, value in values.items()}
    config = laid_over(Config(), checked, lambda key: f"f\n.toml: {key}", "f\n.toml")
    printed = "\n".join(as_toml(config))
    # Of what is not shown, a terminal would obey some.
    assert printed.replace("\n", "").isprintable()
    read = {key: CHECKS[key]("x", value) for key, value in tomllib.loads(printed).items()}
    again = laid_over(Config(), read, lambda key: f"x: {key}", "x")
    assert _plain(again) == _plain(config)


def _plain(config: Config) -> str:
    """The settings in words, in which not-a-number is what it is, and order counts."""
    said = {**config._asdict(), "origins": None}
    for key in ("suppress", "per_path"):
        said[key] = [each.as_written() for each in said[key]]
    said["options"] = {name: table for name, table in said["options"].items() if table}
    return repr(_without_tuples(said))


def _without_tuples(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _without_tuples(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_without_tuples(item) for item in value]
    return math.copysign(value, value) if isinstance(value, float) else value


def test_bytes_that_are_no_text_can_not_be_written(tmp_path: Path) -> None:
    pack = os.fsdecode(b"/packs/\xff")
    with pytest.raises(UsageError) as raised:
        list(as_toml(Config(packs=(pack,))))
    assert str(raised.value) == "packs holds bytes that are no text, which no TOML file can have"
