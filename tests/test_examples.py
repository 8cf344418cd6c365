"""The example shots, and the documentation held to what the tool really does."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from process import ROOT

from usdvol_lint.command.cli import command
from usdvol_lint.config import Config
from usdvol_lint.config.values import CHECKS

GOLDEN = ROOT / "tests" / "golden" / "broken-shot.txt"
GUIDES = [*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md")]
PAGES = [*GUIDES, *ROOT.glob("rules/**/*.md")]

EXAMPLES_ALONE = ("--isolated", "--ignore", "LNT004")  # of an old USD, not of the examples

BLOCK = re.compile(r"^```(?P<language>\w+)\n(?P<text>.*?)^```$", re.MULTILINE | re.DOTALL)
SESSION = re.compile(r"\A\$ usdvol-lint (?P<arguments>.*)\n(?P<output>(?:.|\n)+)")
LINK = re.compile(r"\]\((?!https?:)(?P<path>[^)#]+)\)")
OPTION = re.compile(r"(?<![\w-])--[a-z][a-z-]*")
FOREIGN = re.compile(r"\b(?:python -m tests|pip install|git [a-z]+)\b[^`\n]*")
"""Commands with options of their own."""


def run(*arguments: str, folder: Path = ROOT) -> subprocess.CompletedProcess[str]:
    """What a user sees who types this."""
    return subprocess.run(
        [sys.executable, "-P", "-m", "usdvol_lint", "--color", "never", *arguments],
        cwd=folder,
        capture_output=True,
        text=True,
        encoding="utf-8",
        check=False,
    )


def blocks(path: Path, language: str) -> list[str]:
    text = path.read_text(encoding="utf-8")
    return [block["text"] for block in BLOCK.finditer(text) if block["language"] == language]


def without_times(text: str) -> str:
    return re.sub(r" in [\d.,]+ s\b", " in ? s", text)


def ids(path: Path) -> str:
    return str(path.relative_to(ROOT))


def test_good_shot_is_clean() -> None:
    done = run(*EXAMPLES_ALONE, "--quiet", "--fail-on", "info", "docs/examples/shot")
    assert (done.stdout, done.stderr, done.returncode) == ("", "", 0)


def test_broken_shot_reports_what_is_wrong_with_it() -> None:
    done = run(*EXAMPLES_ALONE, "--output-format", "concise", "docs/examples/broken")
    assert done.stdout == GOLDEN.read_text(encoding="utf-8")
    assert (done.stderr, done.returncode) == ("", 1)


def test_broken_shot_differs_only_in_what_its_story_names() -> None:
    """The twins stay twins: what one has beside the defects, the other has too."""
    good, broken = ROOT / "docs" / "examples" / "shot", ROOT / "docs" / "examples" / "broken"
    names = {path.relative_to(broken) for path in broken.rglob("*") if path.is_file()}
    lost = {path.relative_to(good) for path in good.rglob("*") if path.is_file()} - names
    differing = {
        name for name in names if (good / name).read_bytes() != (broken / name).read_bytes()
    }
    assert lost == {Path(f"cache/puff.000{frame}.vdb") for frame in (3, 4, 7)}
    assert differing == {
        Path("cache/puff.0005.vdb"),
        Path("effects.usda"),
        Path("shot.usda"),
        Path("splats.usda"),
    }


def test_examples_stay_small() -> None:
    files = [path for path in (ROOT / "docs" / "examples").rglob("*") if path.is_file()]
    assert sum(path.stat().st_size for path in files) < 300_000


@pytest.mark.parametrize("path", GUIDES, ids=ids)
def test_sessions_show_real_output(path: Path) -> None:
    """`$ usdvol-lint …` and what follows it: a line with `…` alone stands for what is left out."""
    for block in blocks(path, "console"):
        if session := SESSION.match(block):
            said = without_times(run(*EXAMPLES_ALONE, *session["arguments"].split()).stdout)
            for piece in re.split(r"^…\n", without_times(session["output"]), flags=re.MULTILINE):
                assert piece in said


def test_readme_shows_a_session() -> None:
    assert any(SESSION.match(block) for block in blocks(ROOT / "README.md", "console"))


def test_make_targets_exist() -> None:
    targets = re.findall(r"^(\w+):", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE)
    wanted = {
        target
        for path in GUIDES
        for target in re.findall(
            r"(?:^|`)make (\w+)", path.read_text(encoding="utf-8"), re.MULTILINE
        )
    }
    assert {"demo", "test"} <= wanted <= set(targets)


@pytest.mark.parametrize("path", PAGES, ids=ids)
def test_links_lead_somewhere(path: Path) -> None:
    for link in LINK.finditer(path.read_text(encoding="utf-8")):
        assert (path.parent / link["path"]).exists(), link["path"]


@pytest.mark.parametrize("path", GUIDES, ids=ids)
def test_options_exist(path: Path) -> None:
    known = {name for parameter in command.params for name in parameter.opts} | {"--help"}
    text = FOREIGN.sub("", path.read_text(encoding="utf-8"))
    assert set(OPTION.findall(text)) <= known


def test_configuration_reference_is_complete() -> None:
    """Every key of the table exists, with the default that it has, and none is left out."""
    text = (ROOT / "docs" / "configuration.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| `([a-z-]+)` \| [^|]+ \| ([^|]+) \| ([^|]+) \|$", text, re.MULTILINE)
    defaults = {name.replace("_", "-"): value for name, value in Config()._asdict().items()}
    assert [key for key, _, _ in rows] == list(CHECKS)
    for key, default, example in rows:
        if default.startswith("`") and defaults[key]:
            assert tomllib.loads(f"x = {default.strip('`')}")["x"] == defaults[key]
        if example.startswith("`"):
            assert key in tomllib.loads(example.strip("`"))


@pytest.mark.parametrize("path", GUIDES, ids=ids)
def test_configurations_are_accepted(path: Path, tmp_path: Path) -> None:
    for block in blocks(path, "toml"):
        table = tomllib.loads(block)
        for folder in table.get("search-path", []):
            (tmp_path / folder).mkdir()
        if "packs" in table or "project" in table:
            continue
        name = "pyproject.toml" if "tool" in table else "usdvol-lint.toml"
        (tmp_path / name).write_text(block, encoding="utf-8")
        done = run("--show-settings", "--output-format", "json", folder=tmp_path)
        assert done.returncode == 0, done.stderr
        assert json.loads(done.stdout)["config_file"] == str(tmp_path / name)
        (tmp_path / name).unlink()


def test_rule_pack_of_the_guide_works(tmp_path: Path) -> None:
    guide = ROOT / "docs" / "getting-started.md"
    (module,) = blocks(guide, "python")
    (settings,) = (block for block in blocks(guide, "toml") if "packs" in tomllib.loads(block))
    folder = tmp_path / "pipeline" / "rules"
    folder.mkdir(parents=True)
    (folder / "file_outside_store.py").write_text(module, encoding="utf-8")
    (tmp_path / "studio.toml").write_text(settings, encoding="utf-8")
    shot = os.path.relpath(ROOT / "docs" / "examples" / "shot" / "assets", tmp_path)
    done = run("--config", "studio.toml", "--output-format", "json", shot, folder=tmp_path)
    causes = json.loads(done.stdout)["causes"]
    assert {(cause["code"], cause["message"]) for cause in causes} == {
        ("PIP001", "'../cache/puff.0008.vdb' lies outside '/mnt/caches/'")
    }


def test_architecture_names_every_folder() -> None:
    text = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    package = ROOT / "usdvol_lint"
    modules = {path.stem for path in package.glob("*.py")} - {"__init__"}
    folders = {path.parent.name for path in package.glob("*/__init__.py")}
    assert {name for name in modules | folders if f"`{name}`" not in text} == set()
    wings = {path.parent.name for path in package.glob("facts/*/__init__.py")}
    drawn = set(re.findall(r"\b([a-z]+)\[", text))
    assert wings | folders <= drawn
