"""Signals before the first stage, and while reports are written."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from process import ONLY_STUDIO, environment, volume, write

pytestmark = pytest.mark.skipif(os.name != "posix", reason="signals as POSIX has them")

PROGRAM = """
import os, signal
from usdvol_lint import child
from usdvol_lint.__main__ import main
from usdvol_lint.run import lint

def after(call):
    def called(*arguments):
        result = call(*arguments)
        os.kill(os.getpid(), {number})
        return result
    return called

{where} = after({where})
main()
"""
REPORT = ("--output-format", "json", "--output", "report.json")


def command(number: int, where: str, *arguments: str) -> list[str]:
    program = PROGRAM.format(number=int(number), where=where)
    return [sys.executable, "-P", "-c", program, *map(str, ONLY_STUDIO), *REPORT, *arguments, "."]


def signalled(
    number: int, where: str, *arguments: str, cwd: Path
) -> subprocess.CompletedProcess[str]:
    """A run that is sent a signal whenever something was called."""
    return subprocess.run(
        command(number, where, *arguments),
        cwd=cwd,
        env=environment(),
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM", "SIGHUP"])
def test_before_anything_is_imported(name: str, tmp_path: Path) -> None:
    """An older report must not pass for that of this run."""
    write(tmp_path, smoke=volume("smoke"))
    (tmp_path / "report.json").write_text("old")
    number = signal.Signals[name]
    done = signalled(number, "child.start_child", cwd=tmp_path)
    said = f"usdvol-lint: interrupted by {name}\n"
    assert (done.returncode, done.stdout, done.stderr) == (128 + number, "", said)
    report = json.loads((tmp_path / "report.json").read_text())
    why = f"interrupted by {name} before any stage was checked"
    assert (report["partial"], report["failure"]) == (True, why)


@pytest.mark.parametrize("where", ["lint.settings_of", "os.urandom"])
def test_what_is_begun_to_be_written_is_finished(where: str, tmp_path: Path) -> None:
    """Where a file is begun a name is made up: that of the report comes with a second signal."""
    write(tmp_path, smoke=volume("smoke"))
    asked = ("--root", ".", "--write-baseline", "known.jsonl")
    done = signalled(signal.SIGTERM, where, *asked, cwd=tmp_path)
    said = "usdvol-lint: interrupted by SIGTERM once all stages were done\n"
    assert (done.returncode, done.stderr) == (143, said)
    assert sorted(os.listdir(tmp_path)) == ["known.jsonl", "report.json", "smoke.usda"]
    report = json.loads((tmp_path / "report.json").read_text())
    assert (report["partial"], report["failure"], len(report["stages"])) == (False, None, 1)


def test_a_closed_terminal_takes_no_text_and_a_file_its_report(tmp_path: Path) -> None:
    write(tmp_path, smoke=volume("smoke"))
    ours, theirs = os.openpty()
    asked = command(signal.SIGHUP, "child.start_child", "--output-format", "json")
    with subprocess.Popen(
        asked, cwd=tmp_path, env=environment(), stdout=theirs, stderr=theirs
    ) as process:
        os.close(theirs)
        os.close(ours)
    assert process.returncode == 128 + signal.SIGHUP
    assert json.loads((tmp_path / "report.json").read_text())["partial"] is True
