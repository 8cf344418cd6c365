"""Takes small stages forward side by side: the code that one needs is still at hand for the next.

A stage needs so much code of USD's and ours that the processor's caches hold little of it by the
time that the next one comes: one after the other, small stages take twice as long.
"""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Generator, Iterable
from typing import TypeAlias

from usdvol_lint.engine.undecoded import Undecoded
from usdvol_lint.model import Finding, StageReport

_LONG = 0.02
"""After a step of so many seconds the others wait: their stages need not be in memory together."""

Steps: TypeAlias = Generator[StageReport | None, None, None]
"""Yields None where another stage may go on, and in the end the report; then lets the stage go."""


class Stopwatch:
    """Wall-clock seconds by phase, of this stage alone: `since` is when it went on."""

    def __init__(self) -> None:
        self.seconds: dict[str, float] = {}
        self.since = time.perf_counter()
        self._kept = 0.0

    def lap(self, phase: str) -> None:
        now = time.perf_counter()
        self.seconds[phase] = self.seconds.get(phase, 0.0) + self._kept + now - self.since
        self.since, self._kept = now, 0.0

    def pause(self, now: float) -> None:
        """Says that another stage goes on now."""
        self._kept += now - self.since


class Course:
    """What happens to one stage; its findings go to `send` once those before it are done.

    `broken` is text that USD could not read until now.
    """

    def __init__(self, path: str, send: Callable[[list[Finding]], None]) -> None:
        self.path = path
        self.clock = Stopwatch()
        self.broken: list[UnicodeDecodeError] = []
        self.report: StageReport | None = None
        self._send = send
        self._held: list[Finding] = []
        self._is_first = False

    def begin(self, steps: Steps) -> None:
        self._steps = steps

    def send(self, findings: list[Finding]) -> None:
        """Sends findings, as soon as all stages before this one are done."""
        if self._is_first:
            self._send(findings)
        else:
            self._held += findings

    def lead(self) -> None:
        """Says that the stages before this one are done."""
        self._is_first = True
        if self._held:
            self._send(self._held)

    def go_on(self, since: float) -> float:
        """Goes on to the next step, and returns when that was done."""
        self.clock.since = since
        self.report = next(self._steps)
        now = time.perf_counter()
        self.clock.pause(now)
        return now

    def end(self) -> None:
        """Lets the stage go."""
        self._steps.close()


def take(
    courses: Iterable[Course],
    answer: Callable[[StageReport], object],
    parted: Callable[[], object] = lambda: None,
) -> None:
    """Takes stages to their ends, side by side until a step takes long.

    `answer` is called with the reports in the order of the stages, each before its stage is let go;
    `parted` once they go on one after the other.
    """
    ahead = deque(courses)
    ahead[0].lead()
    now = time.perf_counter()
    is_long = False
    with Undecoded() as undecoded:
        while ahead:
            for course in (ahead[0],) if is_long else tuple(ahead):
                if course.report is None:
                    undecoded.heard = course.broken
                    before, now = now, course.go_on(now)
                    if not is_long and now - before > _LONG:
                        is_long = True
                        parted()
                if is_long:
                    break
            while ahead and (report := ahead[0].report):
                answer(report)
                ahead.popleft().end()
                if ahead:
                    ahead[0].lead()
                now = time.perf_counter()
