"""Whatever a run is started in, it says what is wrong and exits with 2, and destroys nothing."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from process import PROGRAM, ROOT, environment, run, volume, write

BROKEN = '#usda 1.0\ndef OpenVDBAsset "a"\n{\n    asset filePath = @./gone.vdb@\n}\n'
ONLY = ("--isolated", "--select", "AST002")

POSIX = pytest.mark.skipif(os.name != "posix", reason="needs a POSIX shell")


def shell(line: str, folder: Path) -> subprocess.CompletedProcess[str]:
    program = " ".join(f"'{word}'" for word in PROGRAM)
    return subprocess.run(
        ["sh", "-c", line.replace("usdvol-lint", program)],
        cwd=folder,
        env=environment(),
        capture_output=True,
        text=True,
        check=False,
    )


@POSIX
def test_a_closed_standard_error_changes_nothing(tmp_path: Path) -> None:
    (tmp_path / "a.usda").write_text(BROKEN)
    done = shell("usdvol-lint --isolated --select AST002 a.usda 2>&-", tmp_path)
    assert (done.returncode, "AST002 error" in done.stdout) == (1, True)


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs /dev/full")
def test_an_error_that_nobody_can_read_is_no_finding(tmp_path: Path) -> None:
    assert shell("usdvol-lint --nope 2>/dev/full", tmp_path).returncode == 2
    assert shell("usdvol-lint gone.usda 2>/dev/full", tmp_path).returncode == 2


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs /dev/full")
@pytest.mark.parametrize("option", ["--help", "--version"])
def test_what_can_not_be_printed_is_said(option: str, tmp_path: Path) -> None:
    done = shell(f"usdvol-lint {option} >/dev/full", tmp_path)
    said = "usdvol-lint: error: can't write to standard output: No space left on device\n"
    assert (done.returncode, done.stderr) == (2, said)


@POSIX
def test_no_handles_left(tmp_path: Path) -> None:
    (tmp_path / "a.usda").write_text(BROKEN)
    done = shell("ulimit -n 8; usdvol-lint --isolated a.usda", tmp_path)
    said = (
        "usdvol-lint: error: no process can be started: Too many open files; "
        "this shell allows a process 8 open files (ulimit -n): raise that\n"
    )
    assert (done.returncode, done.stdout, done.stderr) == (2, "", said)


@pytest.mark.parametrize(
    ("output", "said"),
    [
        ("other.usda", "a report is not written to a file that is called like an input"),
        ("new.vdb", "a report is not written to a file that is called like an input"),
        ("usdvol-lint.toml", "a report is not written to a file that is called like an input"),
        ("stage", "the run reads this file"),
        ("list.txt", "the run reads this file"),
    ],
)
def test_no_report_goes_over_an_input(output: str, said: str, tmp_path: Path) -> None:
    write(tmp_path, a=volume("fog"), other=volume("fog"))
    (tmp_path / "stage").write_text(BROKEN)
    (tmp_path / "list.txt").write_text("a.usda\n")
    before = {path: path.read_bytes() for path in tmp_path.iterdir()}
    files = ("--files-from", "list.txt", "stage")
    ran = run(*ONLY, *files, "--output-format", "json", "--output", output, cwd=tmp_path)
    assert (ran.code, ran.out) == (2, "")
    assert ran.err.startswith(f"usdvol-lint: error: --output {output}: {said}")
    assert {path: path.read_bytes() for path in tmp_path.iterdir()} == before


@POSIX
def test_no_link_leads_to_an_input(tmp_path: Path) -> None:
    """Neither a report nor a baseline, whoever put the link there."""
    write(tmp_path, a=volume("fog"))
    for name, target in {"r.json": "cache.vdb", "k.jsonl": "empty.usda"}.items():
        (tmp_path / target).write_text("" if name == "k.jsonl" else "voxels")
        (tmp_path / name).symlink_to(target)
    before = {path: path.read_bytes() for path in tmp_path.iterdir()}
    report = ("--output-format", "json", "--output", "r.json")
    for asked in (report, ("--root", ".", "--write-baseline", "k.jsonl")):
        ran = run(*ONLY, *asked, "a.usda", cwd=tmp_path)
        assert (ran.code, ran.out) == (2, "")
        assert ran.err.endswith("a file that is called like an input: name another one\n")
    assert {path: path.read_bytes() for path in tmp_path.iterdir()} == before


def test_modules_of_a_checkout_are_not_imported(tmp_path: Path) -> None:
    for name in ("click", "pxr", "numpy", "gc"):
        (tmp_path / f"{name}.py").write_text(f"raise SystemExit('imported {name}')")
    (tmp_path / "a.usda").write_text(BROKEN)
    env = environment(PYTHONPATH=str(ROOT))
    done = subprocess.run(
        [sys.executable, "-m", "usdvol_lint", *ONLY, "a.usda"],
        cwd=tmp_path,
        env=env,
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, "AST002 error" in done.stdout, done.stderr) == (1, True, "")
