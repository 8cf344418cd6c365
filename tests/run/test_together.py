"""Small stages are looked at side by side; what ends the process is told of the one that did it."""

from __future__ import annotations

import io
import pickle
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import pytest
from badinput import POSIX, RULE, pack, statuses
from process import ROUGH, run, volume, write

from usdvol_lint.model import StageReport, Status
from usdvol_lint.run import worker
from usdvol_lint.run.group import Group
from usdvol_lint.run.protocol import Done, Together

ROUGH_ONLY = ("--isolated", "--pack", ROUGH, "--select", "RGH", "--output-format", "json")


@pytest.mark.skipif(not POSIX, reason="signals as POSIX has them")
def test_each_stage_is_told_once_whatever_ends_the_process(tmp_path: Path) -> None:
    ends = {17: "exit", 25: "hang", 26: "segfault"}
    names = {f"s{n:02}": ends.get(n, f"s{n:02}") for n in range(40)}
    write(tmp_path, **{file: volume(name) for file, name in names.items()})
    start = "open('starts', 'a').write('.')\n"
    pack(tmp_path / "count", a=start + RULE.format(code="CNT001", name="a"))
    ran = run(*ROUGH_ONLY, "--pack", "count", "--timeout", "1", "-j1", ".", cwd=tmp_path)
    assert (ran.code, ran.err) == (2, "")
    how = {"exit": "crashed", "segfault": "crashed", "hang": "timed_out"}
    assert statuses(ran) == {
        f"{file}.usda": how.get(name, "checked") for file, name in names.items()
    }
    said = {stage["path"]: [each["message"] for each in stage["findings"]] for stage in ran.stages}
    assert len(ran.stages) == len(names)
    # By the parent and the first process, and one after each end: of those with others, of each
    # alone but the last, which is not looked at with others again.
    assert len((tmp_path / "starts").read_text(encoding="utf-8")) == 7
    assert {path for path, told in said.items() if told == ["behaved"]} == {
        f"{file}.usda" for file, name in names.items() if name not in how
    }
    assert all(len(told) == 1 for told in said.values())


class Engine:
    """What a worker asks to lint, a second for each stage whose name says that it is slow."""

    def __init__(self, clock: list[float]) -> None:
        self.asked: list[Sequence[str]] = []
        self._clock = clock

    def lint_together(
        self,
        paths: Sequence[str],
        answer: Callable[[StageReport], None],
        parted: Callable[[], None],
    ) -> None:
        self.asked.append(paths)
        for path in paths:
            self._clock[0] += 1.0 if "slow" in path else 0.001
            if "slow" in path:
                parted()
            answer(StageReport(path, Status.CHECKED))


class Requests:
    def __init__(self, *paths: str) -> None:
        self._paths = list(paths)

    def next(self) -> str | None:
        return self._paths.pop(0) if self._paths else None

    def more(self, most: int) -> list[str]:
        more, self._paths = self._paths[:most], self._paths[most:]
        return more


class Pipe(io.BytesIO):
    """What was written, each time that it was sent."""

    def __init__(self) -> None:
        super().__init__()
        self.sent: list[list[Any]] = []

    def flush(self) -> None:
        self.seek(0)
        messages = []
        while self.tell() < len(self.getvalue()):
            messages += pickle.load(self)
        self.sent.append(messages)
        self.seek(0)
        self.truncate()


def answered(
    monkeypatch: pytest.MonkeyPatch, *paths: str, concerns: Any = None
) -> tuple[list[int], list[list[Any]]]:
    """How many stages were looked at together, and what was sent."""
    clock = [0.0]
    monkeypatch.setattr(worker.time, "perf_counter", lambda: clock[0])
    engine, pipe = Engine(clock), Pipe()
    threads: Any = type("Threads", (), {"opened": lambda self, seconds: None})()
    requests: Any = Requests(*paths)
    worker._answer(requests, worker._Answers(pipe), engine, concerns, threads)  # type: ignore[arg-type]
    return [len(asked) for asked in engine.asked], pipe.sent


def paths_of(messages: list[Any]) -> list[str]:
    return [each.report.path for each in messages if isinstance(each, Done)]


def test_the_first_stage_shows_whether_they_are_small(monkeypatch: pytest.MonkeyPatch) -> None:
    small = [f"{number}" for number in range(20)]
    together, sent = answered(monkeypatch, *small)
    assert together == [1, 16, 3]
    alone, *groups = sent
    assert paths_of(alone) == small[:1]
    assert [each.stages for (each,) in groups[::2] if isinstance(each, Together)] == [16, 3]
    assert [paths_of(each) for each in groups[1::2]] == [small[1:17], small[17:]]


def test_stages_that_take_long_are_looked_at_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    together, sent = answered(monkeypatch, "a", "b", "slow c", "d", "e", "f")
    assert together == [1, 5]
    # What takes long to come is sent as it comes, after that they go on one after the other.
    assert [paths_of(each) for each in sent[2:]] == [["b"], ["slow c"], ["d"], ["e"], ["f"]]
    assert sent[2][-1] == Together(1)
    together, _ = answered(monkeypatch, "slow a", "slow b", "c", "d", "e")
    assert together == [1, 1, 1, 2]


def test_stages_that_may_not_be_concerned_are_asked_one_by_one(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    together, sent = answered(monkeypatch, *"abcd", concerns=lambda path: path != "b")
    assert together == [1, 1, 1]
    assert [paths_of(each) for each in sent] == [["a"], ["b"], ["c"], ["d"]]


def test_stages_together_have_little_time_before_each_has_its_own() -> None:
    """Else one that never ends would take its limit twice."""
    group = Group()
    assert (group.limit(300), group.asked("a", "b")) == (300, ("a", "b"))
    group.of = 2
    assert (group.limit(300), group.limit(2), group.asked("a", "b")) == (5, 2, ("a", "b"))
    assert group.take_apart()
    for _ in range(2):
        assert (group.limit(300), group.asked("a", "b"), group.take_apart()) == (300, ("a",), False)
        group.answered()
    assert group.asked("c", "d") == ("c", "d")
