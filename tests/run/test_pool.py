"""When further workers start, and what becomes of answers whose process is replaced."""

from __future__ import annotations

import subprocess
import sys
import threading
import time
from typing import Any

import pytest
from process import environment

from usdvol_lint.model import StageReport, Status, UsageError
from usdvol_lint.run import pool, supervisor
from usdvol_lint.run.memory import Memory
from usdvol_lint.run.pool import Pool
from usdvol_lint.run.protocol import Setup
from usdvol_lint.run.supervisor import Worker

NOTHING: Any = [None] * len(Setup._fields)
FOR_EVER = 1e6
AT_MOST = 20.0
"""Seconds that a test waits which fails."""

CHILD = """
import os, pickle, sys
from usdvol_lint.model import StageReport, Status
from usdvol_lint.run.protocol import Done, Ready, Together
def say(*messages):
    pickle.dump(messages, sys.stdout.buffer)
    sys.stdout.buffer.flush()
pickle.load(sys.stdin.buffer)
say(Ready("26.11"))
while True:
    paths = pickle.load(sys.stdin.buffer)
    say(Together(len(paths)), *[
        Done(StageReport(each, Status.CHECKED, {"process": os.getpid()}), ()) for each in paths
    ])
"""


def child() -> subprocess.Popen[bytes]:
    """A process that answers all paths at once that it is sent at once."""
    pipes = dict.fromkeys(("stdin", "stdout", "stderr"), subprocess.PIPE)
    return subprocess.Popen([sys.executable, "-P", "-c", CHILD], env=environment(), **pipes)


def test_a_stage_is_asked_again_where_its_process_is_replaced(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Of several that were answered at once, since the one that has grown goes."""
    monkeypatch.setattr(supervisor, "start_child", child)
    monkeypatch.setattr(supervisor, "_START_AHEAD", 0.0)
    grown = iter([False, False, True])
    monkeypatch.setattr(Memory, "has_grown", lambda *_: next(grown, False))
    worker = Worker()
    worker.prepare(Setup(*NOTHING), AT_MOST)
    paths = list("abcdefghijkl")
    reports = [
        worker.lint(path, AT_MOST, lambda samples: None, paths[1:] if path == "a" else ())
        for path in paths
    ]
    worker.stop()
    assert [report.path for report in reports] == paths
    processes = [report.stats["process"] for report in reports]
    assert processes == [processes[0]] * 3 + [processes[-1]] * 9
    assert processes[0] != processes[-1]


class Started:
    """In the place of a worker: its stages take so many seconds of a clock of their own."""

    all: list[Started]
    prepared: list[Started]
    seconds: float
    refuses = False
    rests = 0.0
    """Seconds in which others may become ready after each stage."""
    waits_for = 1
    """All stages but the first end once so many are ready."""
    are_ready: threading.Event
    clock: float
    usd_version, said = "", ()

    def __init__(self, process: object = None) -> None:
        self.is_over = False
        self.all.append(self)

    def prepare(self, *_: object) -> None:
        if self.refuses:
            raise UsageError("no rule today")
        self.prepared.append(self)
        if len(self.prepared) == self.waits_for:
            self.are_ready.set()

    def lint(self, path: str, *_: object) -> StageReport:
        type(self).clock += self.seconds
        if path != "0":
            assert self.are_ready.wait(AT_MOST)
        time.sleep(self.rests)
        return StageReport(path, Status.CHECKED)

    def kill(self) -> None:
        self.is_over = True

    def stop(self) -> None:
        self.is_over = True


@pytest.fixture
def started(monkeypatch: pytest.MonkeyPatch) -> type[Started]:
    """No worker ever starts because a delay is over."""
    fresh = {"all": [], "prepared": [], "clock": 0.0, "are_ready": threading.Event()}
    started = type("Fresh", (Started,), fresh)
    monkeypatch.setattr(pool, "Worker", started)
    monkeypatch.setattr(pool, "_START_DELAY", FOR_EVER)
    monkeypatch.setattr(pool, "owned", lambda: 8)
    monkeypatch.setattr(pool.time, "perf_counter", lambda: started.clock)
    return started


def worked_off(stages: int, jobs: int = 3) -> None:
    """Has so many stages checked."""
    workers = Pool()
    answers = [workers.submit(str(number)) for number in range(stages)]
    try:
        workers.run(Setup(*NOTHING), jobs, AT_MOST)
        assert all(answer.result().status is Status.CHECKED for answer in answers)
    finally:
        workers.close()


def test_for_a_few_small_stages_one_worker_is_enough(started: type[Started]) -> None:
    started.seconds, started.rests = 0.01, 0.001
    worked_off(300)
    assert len(started.all) == len(started.prepared) == 1


def test_further_workers_start_once_stages_take_long(started: type[Started]) -> None:
    started.seconds, started.waits_for = 2 * FOR_EVER, 3
    worked_off(6)
    assert len(started.prepared) == 3


def test_for_very_many_stages_some_start_with_the_first(started: type[Started]) -> None:
    started.seconds, started.waits_for = 0.0, 3
    worked_off(2 * pool._WORTH_ONE, jobs=8)
    assert len(started.prepared) == 3


def test_those_that_start_with_a_first_that_refuses_end_with_it(started: type[Started]) -> None:
    started.seconds, started.refuses = 0.0, True
    with pytest.raises(UsageError, match="no rule today"):
        worked_off(pool._WORTH_ONE)
    assert [each.is_over for each in started.all] == [True, True]
