"""A cause is on standard output once it is met, whatever takes long after it, or before."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import IO

import pytest
from process import PROGRAM, ROUGH, STUDIO, environment, run, volume, write

from usdvol_lint.command.failed import failed
from usdvol_lint.command.output import Destination
from usdvol_lint.command.progress import ProgressBar
from usdvol_lint.command.streaming import Streams
from usdvol_lint.config import Config
from usdvol_lint.model import Cover, Finding, Severity, Site, Source, StageReport, Status
from usdvol_lint.report import Options
from usdvol_lint.run.causes import Causes
from usdvol_lint.run.folding import folded

SLOW = ("--isolated", "--pack", str(ROUGH), "--select", "RGH", "--jobs", "1")


@contextmanager
def running(*arguments: str, cwd: Path) -> Iterator[tuple[subprocess.Popen[bytes], IO[bytes]]]:
    process = subprocess.Popen(
        [*PROGRAM, *SLOW, *arguments], cwd=cwd, env=environment(), stdout=subprocess.PIPE
    )
    with process:
        assert process.stdout
        try:
            yield process, process.stdout
        finally:
            process.kill()


@pytest.mark.parametrize(
    ("format", "first"),
    [
        ("full", ["a.usda\n", "  /fog\n", "    RGH001 error: behaved\n"]),
        ("concise", ["a.usda:2:1: RGH001 error </fog> behaved\n"]),
    ],
)
def test_a_cause_is_told_before_the_run_ends(
    format: str, first: Sequence[str], tmp_path: Path
) -> None:
    """Where there are so many stages that `full` does not wait for all of them."""
    more = {f"b{number:02}": volume("fog") for number in range(20)}
    write(tmp_path, a=volume("fog"), c=volume("hang"), **more)
    with running("--output-format", format, ".", cwd=tmp_path) as (process, out):
        assert [out.readline().decode() for _ in first] == first
        assert process.poll() is None, "c.usda takes an hour"


def test_lines_and_a_file_that_is_there_once_it_is_whole(tmp_path: Path) -> None:
    write(tmp_path, a=volume("fog"), b=volume("hang"))
    asked = ("--output-format", "jsonl", "--output", "-", "--output-format", "concise")
    with running(*asked, "--output", "out.txt", ".", cwd=tmp_path) as (process, out):
        told = [json.loads(out.readline()) for _ in range(2)]
        assert [line["type"] for line in told] == ["run", "cause"]
        assert told[1]["places"][0]["stage"] == 0
        assert process.poll() is None
        assert not (tmp_path / "out.txt").exists()
        assert len(list(tmp_path.glob(".usdvol-lint-*.tmp"))) == 1
        process.terminate()
        assert json.loads(out.read().splitlines()[-1])["partial"]
    assert (tmp_path / "out.txt").read_text("utf-8").startswith("a.usda:2:1: RGH001 error ")
    assert not list(tmp_path.glob(".usdvol-lint-*.tmp"))


def test_what_is_done_first_waits_for_what_is_told_first(tmp_path: Path) -> None:
    write(tmp_path, a=volume("hang"), b=volume("fog"), c=volume("fog"))
    asked = ("--timeout", "2", "--jobs", "2", "--output-format", "jsonl")
    ran = run(*SLOW, *asked, "c.usda", "b.usda", "a.usda", cwd=tmp_path)
    told = [json.loads(line) for line in ran.out.splitlines()]
    causes = [(each["number"], each["code"]) for each in told if each["type"] == "cause"]
    assert causes == [(0, "LNT001"), (1, "RGH001"), (2, "RGH001")]
    assert [each["path"] for each in told if each["type"] == "stage"] == [
        "a.usda",
        "b.usda",
        "c.usda",
    ]


def test_a_file_that_can_not_be_written_meanwhile_is_tried_again(tmp_path: Path) -> None:
    """And printed where that fails too, as any other."""
    if not Path("/dev/full").exists():
        pytest.skip("no device that is full")
    write(tmp_path, a=volume("fog"))
    asked = ("--pack", str(STUDIO), "--select", "STU", "--output-format", "concise")
    ran = run("--isolated", *asked, "--output", "/dev/full", "a.usda", cwd=tmp_path)
    assert (ran.code, ran.out.count("STU001")) == (2, 1)
    assert ran.err == "usdvol-lint: error: --output /dev/full: No space left on device\n"


def test_a_run_that_breaks_off_leaves_no_half_report(tmp_path: Path) -> None:
    """What was printed ends with why; a file stays as it was."""
    asked = [Destination("jsonl", None), Destination("concise", str(tmp_path / "out.txt"))]
    (tmp_path / "out.txt").write_text("before")
    broken = failed((), RuntimeError("boom"), Config())
    printed: list[str] = []
    with Streams(lambda: (asked, Options())) as streams:
        streams._printer.print = printed.extend  # type: ignore[method-assign, assignment]
        streams.begin(broken)
        done = streams.fail(broken)
    assert done == {asked[0]}
    told = [json.loads(line) for line in printed]
    assert [line["type"] for line in told] == ["run", "summary"]
    assert told[1]["failure"] == "internal error: RuntimeError: boom"
    assert [each.name for each in tmp_path.iterdir()] == ["out.txt"]
    assert (tmp_path / "out.txt").read_text() == "before"


def test_a_run_that_breaks_off_prints_what_was_found() -> None:
    """Also of a few stages, of which nothing is printed before all are done."""
    site, cover = Site("a.usda", "/fog"), Cover(Severity.ERROR)
    found = Finding("AST002", "gone", Severity.ERROR, "gone", site, Source("a.usda"), cover)
    stage = StageReport("a.usda", Status.CHECKED, findings=(found,))
    broken = failed((), RuntimeError("boom"), Config())
    printed: list[str] = []
    with Streams(lambda: ([Destination("full", None)], Options())) as streams:
        streams._printer.print = printed.extend  # type: ignore[method-assign, assignment]
        streams.begin(broken)
        folded(Causes(), [(stage, False)], False, streams)
        assert printed == []
        streams.fail(broken)
    assert "    AST002 error: gone\n" in "".join(printed)


def test_beside_a_baseline_nothing_is_told_before_it_is_compared(tmp_path: Path) -> None:
    write(tmp_path, a=volume("fog"))
    asked = (*SLOW, "--root", ".", "a.usda")
    assert run(*asked, "--write-baseline", "known.jsonl", cwd=tmp_path).code == 0
    ran = run(*asked, "--baseline", "known.jsonl", "--output-format", "concise", cwd=tmp_path)
    assert (ran.code, ran.out, ran.err) == (0, "", "")


def test_the_progress_line_names_what_others_wait_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("usdvol_lint.command.progress._START_DELAY", 0.0)
    with ProgressBar(enabled=True) as progress:
        progress.begin(30)
        progress.awaits("slow\x1b[2J.usda", 0)
        said = []
        for _ in range(29):
            progress.stage_done()
            said.append(progress._bar.tasks[0].fields["said"])
        progress.awaits("next.usda", 29)
        progress.stage_done()
        said.append(progress._bar.tasks[0].fields["said"])
    assert said == [
        *["0 samples"] * 19,
        *[r"0 samples, waiting for slow\x1b[2J.usda"] * 10,
        "0 samples",
    ]
