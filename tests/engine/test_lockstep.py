"""In what order stages go on that are taken forward side by side, and what is told of them."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from usdvol_lint.config import Config
from usdvol_lint.engine import lockstep
from usdvol_lint.engine.assign import Assignment
from usdvol_lint.engine.engine import Engine
from usdvol_lint.engine.lockstep import Course, Steps, take
from usdvol_lint.model import StageReport, Status
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import Catalog


def report(path: str) -> StageReport:
    return StageReport(path, Status.CHECKED)


class Stages:
    """Stages of some steps, and what happens to them, in order."""

    def __init__(self) -> None:
        self.told: list[str] = []

    def course(self, path: str, steps: int) -> Course:
        course = Course(path, lambda found: self.told.append(f"found {''.join(map(str, found))}"))
        course.begin(self._steps(course, steps))
        return course

    def _steps(self, course: Course, steps: int) -> Steps:
        for number in range(steps):
            self.told.append(f"{course.path}{number}")
            found: Any = [f"{course.path}{number}"]
            course.send(found)
            yield None
        yield report(course.path)
        self.told.append("never")

    def take(self, **steps: int) -> list[str]:
        courses = (self.course(path, number) for path, number in steps.items())
        answer = lambda report: self.told.append(f"end {report.path}")  # noqa: E731
        take(courses, answer, lambda: self.told.append("parted"))
        return self.told


def test_stages_go_on_side_by_side_and_are_told_one_after_the_other() -> None:
    assert Stages().take(a=2, b=1, c=0) == [
        *("a0", "found a0", "b0", "a1", "found a1"),
        *("end a", "found b0", "end b", "end c"),
    ]


def test_after_a_step_that_takes_long_the_first_goes_on_alone(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(lockstep, "_LONG", -1.0)
    assert Stages().take(a=2, b=1) == [
        *("a0", "found a0", "parted", "a1", "found a1", "end a"),
        *("b0", "found b0", "end b"),
    ]


def test_a_stage_is_let_go_after_its_answer() -> None:
    told = []

    def steps(course: Course) -> Steps:
        try:
            yield report(course.path)
        finally:
            told.append(f"{course.path} gone")

    def courses() -> Iterator[Course]:
        for path in "ab":
            course = Course(path, lambda found: None)
            course.begin(steps(course))
            yield course

    take(courses(), lambda report: told.append(report.path))
    assert told == ["a", "a gone", "b", "b gone"]


def test_text_that_no_one_can_read_is_of_the_stage_that_asked() -> None:
    """USD tells of it by Python's hook, as here."""
    error = UnicodeDecodeError("utf-8", b"\xff", 0, 1, "no")
    courses = []

    def steps(course: Course) -> Steps:
        yield None
        if course.path == "b":
            sys.excepthook(UnicodeDecodeError, error, None)
        yield None
        yield report(course.path)

    for path in "abc":
        course = Course(path, lambda found: None)
        course.begin(steps(course))
        courses.append(course)
    before = sys.excepthook
    take(courses, lambda report: None)
    assert sys.excepthook is before
    assert [course.broken for course in courses] == [[], [error], []]


def test_the_time_of_a_stage_is_its_own(monkeypatch: pytest.MonkeyPatch) -> None:
    now = 0.0
    monkeypatch.setattr(lockstep.time, "perf_counter", lambda: now)
    seconds = {}

    def steps(course: Course, takes: float) -> Steps:
        nonlocal now
        for phase in ("open", "check"):
            now += takes
            course.clock.lap(phase)
            now += takes
            yield None
        now += takes
        course.clock.lap("check")
        seconds[course.path] = course.clock.seconds
        yield report(course.path)

    courses = []
    for path, takes in (("a", 0.001), ("b", 0.004)):
        course = Course(path, lambda found: None)
        course.begin(steps(course, takes))
        courses.append(course)
    take(courses, lambda report: None)
    assert seconds == {
        "a": {"open": pytest.approx(0.001), "check": pytest.approx(0.004)},
        "b": {"open": pytest.approx(0.004), "check": pytest.approx(0.016)},
    }


def test_what_was_found_before_usd_raises_is_kept(
    catalog: Catalog, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also what no finding was made of yet."""
    fields = "".join(
        f'def OpenVDBAsset "f{number}"\n{{\nasset filePath = @./gone.vdb@\n}}\n'
        for number in range(60)
    )
    stage = tmp_path / "stage.usda"
    stage.write_text(f"#usda 1.0\n{fields}", encoding="utf-8")
    pairs = Assignment.pairs

    def raising(*asked: Any) -> Iterator[Any]:
        yield from pairs(*asked)
        raise UnicodeDecodeError("utf-8", b"\xff", 0, 1, "no")

    config = Config(select=("AST002",))
    whole = Engine(catalog.rules, activate(config, catalog)).lint(str(stage)).findings
    monkeypatch.setattr(Assignment, "pairs", raising)
    cut = Engine(catalog.rules, activate(config, catalog)).lint(str(stage)).findings
    assert len(whole) == 60
    assert set(whole) < set(cut)
    assert {each.code for each in set(cut) - set(whole)} == {"LNT001"}
