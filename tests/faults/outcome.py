"""Runs the tool while something goes wrong, and says what came of it."""

from __future__ import annotations

import json
import subprocess
import tempfile
import time
import uuid
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import psutil
from process import PROGRAM, environment

REPORT, ERROR, WRONG = "report", "error", "WRONG"
_MARK = "USDVOL_LINT_FAULTS"
_LONGEST = 600
_PATIENCE = 10
"""Seconds after which a process that has not gone is an orphan."""
_JSON = ("--output-format", "json")
ONLY = ("--isolated", "--select", "AST002")
_BROKEN = '#usda 1.0\ndef OpenVDBAsset "a"\n{\n    asset filePath = @./gone.vdb@\n}\n'


class Outcome(NamedTuple):
    """A report or a clear error, or what is wrong; and stages by status."""

    kind: str
    why: str = ""
    statuses: Mapping[str, int] = {}


def write_stages(folder: Path, number: int) -> None:
    """Stages with one finding each, in a folder of their own."""
    folder.chmod(0o755)
    (folder / "stages").mkdir()
    for each in range(number):
        (folder / "stages" / f"s{each:04}.usda").write_text(_BROKEN, encoding="utf-8")


def outcome(
    folder: Path,
    *arguments: str,
    before: Sequence[str] = (),
    meanwhile: Callable[[psutil.Process], None] = lambda parent: None,
) -> Outcome:
    """What a run over the stages of a folder comes to.

    `before` are the words that the command is called with, `meanwhile` is called again and again.
    """
    env = environment(**{_MARK: uuid.uuid4().hex})
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        command = [*before, *PROGRAM, *ONLY, *_JSON, *arguments, "stages"]
        with subprocess.Popen(command, cwd=folder, env=env, stdout=out, stderr=err) as run:
            until = time.monotonic() + _LONGEST
            while run.poll() is None and time.monotonic() < until:
                try:
                    meanwhile(psutil.Process(run.pid))
                except psutil.Error:
                    continue
            is_late = run.poll() is None
            run.kill()
        texts = []
        for file in (out, err):
            file.seek(0)
            texts.append(file.read().decode("utf-8", "replace"))
    if is_late:
        return Outcome(WRONG, f"it did not end within {_LONGEST} s")
    if orphans := _orphans(env[_MARK]):
        return Outcome(WRONG, f"{orphans} processes stay behind")
    return _judged(folder, run.returncode, *texts)


def _judged(folder: Path, code: int, out: str, err: str) -> Outcome:
    """What the exit code and the texts of a run come to."""
    if "Traceback" in out + err:
        return Outcome(WRONG, f"a traceback: {err[-300:]}")
    report = _parsed(out)
    if code not in (0, 1, 2) or (report is None and code != 2):
        return Outcome(WRONG, f"exit code {code}: {err[-300:]}")
    if report is None or report.get("failure"):
        lines = err.splitlines()
        is_clear = len(lines) == 1 and "error: " in lines[0] and "internal" not in lines[0]
        return Outcome(ERROR if is_clear else WRONG, err[-300:])
    statuses = Counter(stage["status"] for stage in report["stages"])
    told = Counter(stage["path"] for stage in report["stages"])
    there = sorted(path.relative_to(folder).as_posix() for path in folder.glob("stages/s*"))
    if sorted(told.elements()) != there:
        return Outcome(WRONG, f"{told.total()} of {len(there)} stages told")
    is_whole = set(statuses) <= {"checked"}
    if code != (1 if is_whole else 2):
        return Outcome(WRONG, f"exit code {code} with {dict(statuses)}")
    return Outcome(REPORT, err.strip(), statuses)


def _parsed(out: str) -> Any:
    try:
        return json.loads(out)
    except ValueError:
        return None


def _orphans(mark: str) -> int:
    """How many processes of a run are there once it has ended."""
    until = time.monotonic() + _PATIENCE
    while (found := sum(map(_is_marked(mark), psutil.process_iter()))) and time.monotonic() < until:
        time.sleep(0.05)
    return found


def _is_marked(mark: str) -> Callable[[psutil.Process], bool]:
    def is_marked(process: psutil.Process) -> bool:
        try:
            return process.environ().get(_MARK) == mark
        except (psutil.Error, OSError):
            return False

    return is_marked
