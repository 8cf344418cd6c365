"""The tool as a checkout has it, in an interpreter of its own, and how two differ."""

from __future__ import annotations

import difflib
import json
import os
import subprocess
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from .batches import Case
from .judging import Found, misses
from .shown import by_stage

_OPTIONS = ("--isolated", "--output-format", "json", "--select", "ALL", "--fail-on", "never")
_SHOWN = 24

FLAGS: tuple[tuple[str, ...], ...] = (
    (),
    ("--variants", "all"),
    ("--load", "none"),
    ("--content", "first", "--statistics"),
    ("--content", "off", "--times", "ends"),
    ("--times", "first", "--statistics", "--variants", "all"),
)
"""What batches take in turn where two checkouts are compared."""


class FailedError(Exception):
    """The tool did not write a report."""


class Run(NamedTuple):
    """A run of the tool that may still go on."""

    process: subprocess.Popen[bytes]
    report: Path
    log: Path

    def result(self) -> Any:
        """The report; raises FailedError with what was written instead."""
        code = self.process.wait()
        try:
            return json.loads(self.report.read_text(encoding="utf-8"))
        except (OSError, ValueError):
            log = self.log.read_text(encoding="utf-8", errors="replace")
            raise FailedError(f"exit code {code}: {log[-2000:]}") from None


def start(
    checkout: Path, folder: Path, cases: Sequence[Case], flags: Sequence[str], jobs: int, name: str
) -> Run:
    """Begins to lint the stages with the code of a checkout, each stage by its path."""
    report, log = folder / f"{name}.json", folder / f"{name}.log"
    report.unlink(missing_ok=True)
    command = [str(_interpreter(checkout)), "-P", "-m", "usdvol_lint", *_OPTIONS]
    command += ["--jobs", str(jobs), "--output", str(report), *flags]
    environment = {**os.environ, "PYTHONPATH": str(checkout)}
    with open(log, "wb") as out:
        process = subprocess.Popen(
            [*command, *(case.path for case in cases)],
            cwd=folder,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=out,
            stderr=subprocess.STDOUT,
        )
    return Run(process, report, log)


def _interpreter(checkout: Path) -> Path:
    for place in (".venv/bin/python", ".venv/Scripts/python.exe"):
        if (checkout / place).exists():
            return checkout / place
    return Path(sys.executable)


def judged(cases: Sequence[Case], report: Any) -> Iterator[str]:
    """Each stage of which something else was found than is expected."""
    for case, stage in zip(cases, by_stage(report), strict=True):
        if case.expected is not None:
            keys = ("code", "severity", "prim", "message")
            found = [Found(*(each[key] for key in keys)) for each in stage["findings"]]
            missed = misses(case.expected, found)
            if missed:
                yield "\n    ".join([f"{case.path}  ({case.story})", *missed])


def differences(cases: Sequence[Case], ours: Any, theirs: Any) -> Iterator[str]:
    """Each stage, and what is above the stages, in which two reports differ."""
    pairs = zip(cases, by_stage(ours), by_stage(theirs), strict=True)
    for case, our, their in pairs:
        if our != their:
            yield f"{case.path}  ({case.story})\n{_diff(our, their)}"
    ours, theirs = _above_stages(ours), _above_stages(theirs)
    if ours != theirs:
        yield f"what the report says above its stages\n{_diff(ours, theirs)}"


def _above_stages(report: Any) -> Any:
    """What a report says of the run as a whole, without what may differ between equal runs."""
    return {key: report[key] for key in report.keys() - {"stages", "causes", "run"}}


def _diff(ours: Any, theirs: Any) -> str:
    one, other = (json.dumps(each, indent=1).splitlines() for each in (ours, theirs))
    lines = [
        f"    {line}"
        for line in difflib.unified_diff(one, other, "this checkout", "the other", lineterm="", n=2)
    ]
    more = [f"    … and {len(lines) - _SHOWN} lines more"] if len(lines) > _SHOWN else []
    return "\n".join(lines[:_SHOWN] + more)
