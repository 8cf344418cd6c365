"""What a run comes to is told while it goes on, in the order of the stages, and let go."""

from __future__ import annotations

import weakref
from collections.abc import Iterator
from concurrent.futures import Future

import pytest
from test_folding import ASSET, found

from usdvol_lint.model import Severity, StageReport, Status
from usdvol_lint.results import Cause, Place, Report, StageResult
from usdvol_lint.run.ahead import MOST_AHEAD, Ahead
from usdvol_lint.run.causes import Causes
from usdvol_lint.run.folding import folded

INFO, WARNING, ERROR = Severity
OTHER = ASSET._replace(path="/other")


class Told(list[str]):
    """What a teller hears, a word each."""

    listening = True

    def begin(self, head: Report) -> None:
        self.append("begin")

    def cause(self, number: int, cause: Cause) -> None:
        self.append(f"cause {number} {cause.severity.label} x{cause.count}")

    def place(self, number: int, place: Place) -> None:
        self.append(f"place {number} {place.finding.site.prim}")

    def raised(self, number: int, cause: Cause, was: Severity) -> None:
        self.append(f"raised {number} {was.label} {cause.severity.label} {cause.first.site.prim}")

    def stage(self, number: int, stage: StageResult) -> None:
        self.append(f"stage {number} {stage.causes}")


def stage(name: str, *findings: object) -> StageReport:
    return StageReport(f"{name}.usda", Status.CHECKED, {"prims": 1}, findings)  # type: ignore[arg-type]


def test_each_stage_is_told_before_the_next_is_asked_for() -> None:
    told = Told()
    seen: list[int] = []

    def reports() -> Iterator[tuple[StageReport, bool]]:
        yield stage("a", found("/a"), found("/b")), False
        seen.append(len(told))
        yield stage("b", found("/c"), found("/d", OTHER)), False
        seen.append(len(told))

    folded(Causes("/lib"), reports(), False, told)
    assert told == [
        *("cause 0 error x2", "place 0 /b", "stage 0 (0,)"),
        *("cause 1 error x1", "place 0 /c", "stage 1 (0, 1)"),
    ]
    assert seen == [3, 6]


def test_what_is_worse_later_is_told_once_a_stage() -> None:
    told = Told()
    stages = [
        stage("a", found("/a", severity=INFO)),
        stage("b", found("/b", severity=WARNING), found("/c", severity=ERROR)),
        stage("c", found("/d", severity=ERROR), found("/e", severity=INFO)),
    ]
    folded(Causes("/lib", most=2), ((each, False) for each in stages), False, told)
    assert told == [
        *("cause 0 info x1", "stage 0 (0,)"),
        *("place 0 /b", "raised 0 info error /c", "stage 1 (0,)"),
        "stage 2 (0,)",
    ]


@pytest.mark.parametrize("teller", [None, Told()])
def test_nothing_of_a_stage_is_kept_but_what_it_came_to(teller: Told | None) -> None:
    """Not its findings, but those that a cause carries; what equals that of others is theirs."""
    alive: weakref.WeakSet[Text] = weakref.WeakSet()
    most = 0

    def reports() -> Iterator[tuple[StageReport, bool]]:
        nonlocal most
        for number in range(5000):
            finding = found("/a")._replace(message=Text(str(number)))
            alive.add(finding.message)  # type: ignore[arg-type]
            yield stage(f"s{number}", finding), False
            most = max(most, len(alive))

    stages, [cause] = folded(Causes("/lib", most=3), reports(), False, teller)
    assert (len(stages), cause.count, len(cause.places)) == (5000, 5000, 3)
    assert most <= 3 + 2, "the last one is in hand"
    assert len({id(part) for each in stages for part in (each.stats, each.causes, each.worst)}) == 3


def test_who_does_not_listen_is_told_of_no_cause() -> None:
    """To make causes of what is found so far takes time, and they are made again at the end."""
    told = Told()
    told.listening = False
    folded(Causes("/lib"), [(stage("s0", found("/a")), False)] * 2, False, told)
    assert told == ["stage 0 (0,)", "stage 1 (0,)"]


class Text(str):
    """A text whose life can be watched."""

    __slots__ = ("__weakref__",)


class Queue:
    """A pool whose stages are done when the test says so."""

    expects_more = False

    def __init__(self) -> None:
        self.futures: list[Future[StageReport]] = []

    def submit(self, path: str) -> Future[StageReport]:
        self.futures.append(Future())
        return self.futures[-1]


@pytest.mark.parametrize("number", [1, MOST_AHEAD, MOST_AHEAD + 2])
def test_a_thousand_stages_run_ahead_of_a_slow_one(number: int) -> None:
    pool = Queue()
    done: list[None] = []
    paths = [f"{each}.usda" for each in range(number)]
    ahead = Ahead(pool, paths, lambda: done.append(None))  # type: ignore[arg-type]
    submitted = len(pool.futures)
    assert (submitted, pool.expects_more) == (min(number, MOST_AHEAD), number > MOST_AHEAD)
    for future, path in zip(pool.futures[1:], paths[1:], strict=False):
        future.set_result(stage(path))
    assert (len(pool.futures), len(done)) == (submitted, submitted - 1)
    pool.futures[0].set_result(stage(paths[0]))
    assert ahead.next().path == "0.usda.usda"
    assert len(pool.futures) == min(number, MOST_AHEAD + 1)
    for asked, path in enumerate(paths[1:], 1):
        if asked >= MOST_AHEAD:
            pool.futures[asked].set_result(stage(path))
        assert ahead.next().path == f"{path}.usda"
    assert (len(pool.futures), pool.expects_more) == (number, False)
