"""Runs as data: causes by layer and prim, and the reports that they come to."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import pytest

from usdvol_lint.baseline.fingerprint import fingerprint
from usdvol_lint.baseline.use import Prepared, Use, prepare
from usdvol_lint.model import Cover, Finding, Severity, Site, Source, Status, UsageError
from usdvol_lint.results import Cause, Place, Report, RunInfo, StageResult, State

ANEW = "write the baseline anew"
ERROR, WARNING, INFO = Severity.ERROR, Severity.WARNING, Severity.INFO
SETTINGS = {
    "rules": {"AST001": "error", "AST002": "error", "LNT001": "error", "LNT002": "error"},
    "fail_on": "error",
    "load": "all",
    "content": "all",
    "times": "all",
    "variants": "selected",
    "variant_limit": 100,
}


def cause(
    layer: str | None = "assets/a.usda",
    prim: str | None = "/A",
    *,
    code: str = "AST002",
    name: str | None = "filePath",
    subject: str = "",
    frames: tuple[float, ...] | None = None,
    severity: Severity = ERROR,
    state: State = State.NEW,
    stage: int = 0,
    **cover: Any,
) -> Cause:
    source = Source(layer, prim, name, subject)
    covered = Cover(**{"level": severity, "frames": frames, **cover})
    finding = Finding(code, "x", severity, "x", Site(layer, prim), source, covered)
    mark = fingerprint(code, source)
    return Cause(mark, severity, source, covered, (Place(stage, finding),), 1, state)


def report(
    root: Path | None,
    *causes: Cause,
    arguments: Iterable[str] = (".",),
    statuses: Iterable[Status] = (Status.CHECKED,),
    **settings: Any,
) -> Report:
    """A run whose first stage shows all causes."""
    numbers = tuple(range(len(causes)))
    worst = tuple(each.severity for each in causes)
    stages = [
        StageResult(f"s{number}.usda", status, causes=numbers, worst=worst)
        if number == 0
        else StageResult(f"s{number}.usda", status)
        for number, status in enumerate(statuses)
    ]
    made = Report(
        "0.1",
        None,
        SETTINGS | settings,
        None if root is None else root.as_posix(),
        tuple(stages),
        (),
        RunInfo(),
        arguments=tuple(arguments),
    )
    return made.with_causes(causes)


def written(folder: Path, *causes: Cause, name: str = "b.jsonl", **run: Any) -> Path:
    """A baseline of these causes."""
    file = folder / name
    applied = prepare(Use(write=str(file))).apply(report(folder, *causes, **run))
    assert (applied.failure, applied.report.baseline and applied.report.baseline.written) == (
        "",
        True,
    )
    return file


def using(file: Path, **use: Any) -> Prepared:
    return prepare(Use(read=str(file), **use))


def states(made: Report) -> list[str]:
    return [str(each.state) for each in made.causes]


def held(file: Path) -> list[str]:
    """The entries of a baseline, in words."""
    return sorted(str(entry) for entry in using(file).baseline.entries.values())  # type: ignore[union-attr]


def said(file: Path, call: Callable[[Path], object] = using) -> str:
    """What is said of a file that can't be used, without the folder that it is in."""
    with pytest.raises(UsageError) as caught:
        call(file)
    words = str(caught.value)
    for folder in (str(file.parent), file.parent.resolve().as_posix()):
        words = words.replace(f"{folder}{os.sep}", "").replace(f"{folder}/", "")
    assert "\n" not in words
    return words
