"""The process that loads USD: reads paths from one pipe, writes stage reports to another."""

from __future__ import annotations

import gc
import os
import pickle
import signal
import time
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, BinaryIO

from usdvol_lint.model import Finding, StageReport, Status, UsageError
from usdvol_lint.packs.catalog import load
from usdvol_lint.rule import Rule
from usdvol_lint.run.limits import narrow_limits
from usdvol_lint.run.protocol import (
    Advance,
    Done,
    GivenUp,
    NewFindings,
    Ready,
    Refusal,
    Reply,
    Setup,
    Together,
)
from usdvol_lint.run.requests import Requests

if TYPE_CHECKING:
    from usdvol_lint.engine.engine import Engine
    from usdvol_lint.engine.threads import Threads


_FEW = 10_000
"""So many new objects are not worth looking for garbage."""
_SHARE = 0.05
"""How much of the time may be spent on looking for garbage."""
_SMALL = 0.004
"""Seconds that a stage takes at most which is worth to be looked at beside others."""
_TOGETHER = 16
"""So many stages are: of eight each takes a tenth longer, of 32 as long."""


def main() -> None:
    """Answers each path with a report, until the pipe closes, which ends the process."""
    # Facts are many, live as long as their stage, and have no reference cycles: collecting garbage
    # again and again takes a third of the time on a stage of 100,000 prims.
    gc.disable()
    # Where a terminal interrupts all processes, the parent ends this one: what is raised here as
    # KeyboardInterrupt is raised by a rule.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    requests, replies = _take_pipes()
    try:
        from usdvol_lint.engine.plugins import load_plugins
    except ImportError as error:
        advice = narrow_limits() or (
            ": install usd-core, or put the folder with the pxr of another USD on PYTHONPATH"
        )
        return _send(replies, Refusal(f"USD can't be imported ({error}){advice}"))
    from usdvol_lint.engine.asked_types import check_types
    from usdvol_lint.engine.threads import Threads
    from usdvol_lint.engine.usd_version import usd_version

    threads = Threads()
    said = load_plugins()
    setup: Setup = requests.next()
    try:
        rules = load(setup.packs).rules
        check_types(rules.values())
    except UsageError as error:
        return _send(replies, Refusal(str(error)))
    answers = _Answers(replies)
    engine = _engine(rules, setup, answers)
    _send(replies, Ready(usd_version(), said))
    threads.begin(setup.are_many, setup.workers)
    gc.freeze()  # what all stages share is never garbage
    _answer(requests, answers, engine, _concerned(setup), threads)


def _answer(
    requests: Requests,
    answers: _Answers,
    engine: Engine,
    concerns: Callable[[str], bool] | None,
    threads: Threads,
) -> None:
    """Answers all paths in their order, those of small stages a few at a time."""
    garbage = _Garbage()

    def end(report: StageReport) -> None:
        answers.end(report)
        threads.opened(report.seconds.get("open", 0.0))

    seconds = _SMALL
    while path := requests.next():
        if concerns and not concerns(path):
            answers.begin(1)
            answers.end(_unchanged(path))
            continue
        others = requests.more(_TOGETHER - 1) if seconds < _SMALL and not concerns else ()
        answers.begin(1 + len(others))
        began = time.perf_counter()
        engine.lint_together((path, *others), end, answers.part)
        seconds = (time.perf_counter() - began) / (1 + len(others))
        garbage.collect()


class _Garbage:
    """Looks for reference cycles once in a while, though stages should leave none.

    To look takes the longer the more is kept for the next stages.
    """

    def __init__(self) -> None:
        self._ended = time.perf_counter()
        self._took = 0.0

    def collect(self) -> None:
        began = time.perf_counter()
        if gc.get_count()[0] < _FEW or _SHARE * (began - self._ended) < self._took:
            return
        gc.collect()
        self._ended = time.perf_counter()
        self._took = self._ended - began


def _engine(rules: Mapping[str, Rule], setup: Setup, answers: _Answers) -> Engine:
    from usdvol_lint.engine.engine import Engine

    return Engine(
        rules,
        setup.active,
        setup.depth,
        answers.advance,
        answers.send,
        setup.is_alone,
        setup.suppressions,
        setup.repository,
        answers.give_up,
    )


def _unchanged(path: str) -> StageReport:
    return StageReport(path, Status.CHECKED, is_unchanged=True)


def _concerned(setup: Setup) -> Callable[[str], bool] | None:
    """Whether what changed concerns a stage; None where all stages are checked."""
    if setup.changed is None:
        return None
    from usdvol_lint.engine.dependencies import concerned

    return concerned(setup.changed, setup.depth.storage)


class _Answers:
    """What is said of stages: the findings of each as they come, then its report without them.

    Of stages that are looked at together it is said together: to wake the parent for each is slow,
    as is a pickle for each, and if the process goes, they are looked at again.
    """

    def __init__(self, replies: BinaryIO) -> None:
        self._replies = replies
        self._sent: list[Finding] = []
        self._held: list[Reply] = []
        self._together = 1

    def begin(self, stages: int) -> None:
        """Says how many stages are looked at together from now on."""
        self._together = stages
        if stages > 1:
            _send(self._replies, Together(stages))

    def part(self) -> None:
        """Says that they are looked at one after the other from now on."""
        if self._together > 1:
            self._together = 1
            self._say(Together(1))

    def advance(self, samples: int) -> None:
        self._say(Advance(samples))

    def send(self, findings: list[Finding]) -> None:
        self._sent += findings
        self._say(NewFindings.of(findings))

    def end(self, report: StageReport) -> None:
        numbers = {id(finding): number for number, finding in enumerate(self._sent)}
        order = tuple(numbers.get(id(finding), finding) for finding in report.findings)
        self._say(Done(report._replace(findings=()), order))
        self._sent = []
        self._together -= 1

    def give_up(self, report: StageReport) -> None:
        """Answers while USD is busy with a stage, and ends the process with that."""
        _send(self._replies, *self._held, GivenUp(report))
        os._exit(0)

    def _say(self, message: Reply) -> None:
        self._held.append(message)
        if self._together <= 1:
            _send(self._replies, *self._held)
            self._held.clear()


def _take_pipes() -> tuple[Requests, BinaryIO]:
    """Requests and replies; what anything prints goes to standard error instead."""
    replies = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    requests = os.fdopen(os.dup(0), "rb")
    with open(os.devnull, "rb") as nothing:
        os.dup2(nothing.fileno(), 0)
    return Requests(requests), replies


def _send(replies: BinaryIO, *messages: Reply) -> None:
    pickle.dump(messages, replies, pickle.HIGHEST_PROTOCOL)
    replies.flush()
