"""What has to be quick: nothing is imported before it is needed."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from process import STUDIO

import usdvol_lint
from usdvol_lint import __version__
from usdvol_lint.command import cli

HELP = Path(usdvol_lint.__file__).with_name("help.txt")
PROGRAM = """
import atexit, os, sys
from usdvol_lint.__main__ import main

def tell():
    print(*sys.modules, file=sys.stderr, flush=True)

def leave(code, leave=os._exit):
    tell()
    leave(code)

atexit.register(tell)
os._exit = leave
main()
"""


def run(*arguments: str) -> subprocess.CompletedProcess[str]:
    """A run as the user's, which then tells on standard error what it has imported."""
    return subprocess.run(
        [sys.executable, "-c", PROGRAM, *arguments], capture_output=True, text=True, check=False
    )


@pytest.mark.parametrize("option", ["-h", "--help"])
def test_help_is_what_click_would_print(option: str) -> None:
    assert HELP.read_text(encoding="utf-8") == cli.help_text(), "run `make generate`"
    done = run(option)
    assert (done.stdout, done.returncode) == (cli.help_text(), 0)
    assert "click" not in done.stderr.split()


def test_version() -> None:
    done = run("--version")
    assert (done.stdout, done.returncode) == (f"usdvol-lint {__version__}\n", 0)
    assert "click" not in done.stderr.split()


@pytest.mark.parametrize(
    "arguments",
    [["--list-rules"], ["stage.usda"], ["--test", str(STUDIO)], ["--show-files", "stage.usda"]],
)
def test_only_workers_import_usd(
    arguments: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "stage.usda").write_text('#usda 1.0\ndef Xform "x" {}\n', encoding="utf-8")
    done = run(*arguments)
    assert done.returncode == 0, done.stderr
    imported = set(done.stderr.split())
    assert "usdvol_lint.command.cli" in imported
    assert imported.isdisjoint({"pxr", "numpy", "rich"})
    assert ("usdvol_lint.run.testing" in imported) == ("--test" in arguments)
    assert imported.isdisjoint({"pathspec", "usdvol_lint.files.changes", "usdvol_lint.files.lists"})
    if "--show-files" in arguments:
        assert "usdvol_lint.child" not in imported


def test_a_mistake_on_the_command_line_waits_for_no_worker() -> None:
    done = run("--no-such-option")
    assert done.returncode == 2
    assert "No such option" in done.stderr
