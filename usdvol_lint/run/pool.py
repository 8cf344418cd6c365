"""Worker processes that share a queue of stages."""

from __future__ import annotations

import queue
import threading
import time
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from typing import TYPE_CHECKING, TypeAlias

from usdvol_lint.engine.trouble import report_trouble
from usdvol_lint.model import StageReport, Status, UsageError
from usdvol_lint.run.answers import Answer
from usdvol_lint.run.endings import not_started
from usdvol_lint.run.limits import narrow_limits
from usdvol_lint.run.memory import Memory
from usdvol_lint.run.processors import owned
from usdvol_lint.run.protocol import SHORT, Setup
from usdvol_lint.run.supervisor import NoProcessError, Worker

if TYPE_CHECKING:
    import subprocess

_START_DELAY = 0.3
"""Seconds before each further worker starts: about what it spends on importing USD.

Where there is more to do than that for each, none waits so long.
"""
_WORTH_ONE = 400
"""For so many stages that wait a further worker starts at once, however small they are."""
_SOON = 0.05
"""Seconds after which the first stages tell how long those take that wait."""
_SHORTEST_READY_LIMIT = 60.0
"""Seconds that a worker has at least to import USD and load the rules."""
_IDLE = 0.05
"""Seconds after which a worker without a stage looks whether there will be any more."""
_AHEAD = 64
"""How many small stages a worker has at most beside those that it checks: it never waits."""

_Stage: TypeAlias = tuple[str, Answer]


class InterruptedRunError(Exception):
    """What a stage has in place of a report where the run ended before it."""


class Pool:
    """Workers behind the interface of an executor: `submit` gives the Answer for a stage.

    The first worker starts at once, unless its child process is given; others start only while
    stages are waiting, for very many of them as the run begins.
    """

    def __init__(self, child: subprocess.Popen[bytes] | None = None) -> None:
        self._first = Worker(child)
        self._able = 0
        self._lock = threading.Lock()
        self._waiting: queue.SimpleQueue[_Stage] = queue.SimpleQueue()
        self._workers: list[Worker] = [self._first]
        self._closed = False
        self._unsettled: set[Answer] = set()
        self._why_not: UsageError | None = None
        self._is_worth_all = threading.Event()
        self.expects_more = False
        """Whether more stages will be submitted, so that a worker waits for them."""

    @property
    def usd_version(self) -> str:
        return self._first.usd_version

    @property
    def said(self) -> tuple[str, ...]:
        """What USD said of itself, and not of a stage."""
        return self._first.said

    def submit(self, path: str) -> Answer:
        """Queues a stage; nothing happens to it before `run`."""
        answer = Answer()
        self._unsettled.add(answer)
        self._waiting.put((path, answer))
        if self._closed:
            self._settle(answer, None, InterruptedRunError())
        if self._why_not:
            self._refuse(self._why_not)
        return answer

    def _settle(
        self, answer: Answer, report: StageReport | None, error: Exception | None = None
    ) -> None:
        """Settles what is not settled yet, as it is in a run that was interrupted."""
        try:
            self._unsettled.remove(answer)  # of two threads it is one that can
        except KeyError:
            return
        answer.settle(report, error)

    def run(
        self,
        setup: Setup,
        jobs: int,
        limit: float,
        advance: Callable[[int], None] = lambda samples: None,
        memory: str = "auto",
    ) -> None:
        """Starts to work the queue off with at most `jobs` workers, in threads; does not wait.

        `limit` are the seconds that one stage may take, `memory` is what one worker may keep.
        Raises UsageError if the first worker can't work; if something keeps ending it, or nothing
        can be started, that is what is reported on each stage.
        """
        waiting = self._waiting.qsize()
        workers = max(1, min(jobs, owned(), waiting))
        setup = setup._replace(workers=workers)
        self._able = workers
        delays = [_START_DELAY * max(0, n - waiting // _WORTH_ONE) for n in range(1, workers)]
        # Some import USD while the first one gets ready.
        further = [None if delay else self._further() for delay in delays]
        try:
            self._first.prepare(setup, _ready_limit(limit), Memory(memory, workers))
            _in_a_thread(self._work_off, self._first, limit, advance)
        except NoProcessError as error:
            if not error.is_passing:
                raise
            return self._refuse(error)
        except RuntimeError:
            return self._refuse(UsageError(f"no thread can be started{narrow_limits()}"))
        for delay, worker in zip(delays, further, strict=True):
            own = Memory(memory, workers)
            try:
                _in_a_thread(self._join_later, delay, worker, setup, limit, advance, own)
            except RuntimeError:
                self._give_up(UsageError(f"no thread can be started{narrow_limits()}"))

    def _join_later(
        self,
        delay: float,
        worker: Worker | None,
        setup: Setup,
        limit: float,
        advance: Callable[[int], None],
        memory: Memory,
    ) -> None:
        self._is_worth_all.wait(delay)
        if self._closed or self._is_done():
            return
        worker = worker or self._further()
        try:
            worker.prepare(setup, _ready_limit(limit), memory)
        except UsageError as error:  # the others do its work, or did it and ended the run
            self._give_up(error)
        else:
            self._work_off(worker, limit, advance)

    def _further(self) -> Worker:
        worker = Worker()
        self._workers.append(worker)
        return worker

    def _work_off(self, worker: Worker, limit: float, advance: Callable[[int], None]) -> None:
        taken: deque[_Stage] = deque()
        seconds = 0.0
        done, first = 0, time.perf_counter()
        while not self._closed:
            before = len(taken)
            self._take(taken, seconds)
            if not taken:
                if self._is_done():
                    return
                continue
            new = len(taken) > before
            path, answer = stage = taken.popleft()
            following = [each for each, _ in taken] if new else ()
            began = time.perf_counter()
            try:
                report = worker.lint(path, limit, advance, following)
            except UsageError as error:
                return self._give_up(error, stage, *taken)
            except Exception as error:  # raised again where the result is asked for
                self._settle(answer, None, error)
            else:
                self._settle(answer, report)
            now = time.perf_counter()
            seconds, done = now - began, done + 1
            if now - first > _SOON and not self._is_worth_all.is_set():
                self._weigh((now - first) / done)

    def _weigh(self, seconds: float) -> None:
        """Has all workers start if stages of so many seconds are left for each."""
        if seconds * self._waiting.qsize() > _START_DELAY * self._able:
            self._is_worth_all.set()

    def _take(self, taken: deque[_Stage], seconds: float) -> None:
        """Takes a stage, and more to send ahead if the last one took only so many seconds.

        A worker that has to ask for each small stage waits for a tenth of the time, and one that
        is sent one path after the other is interrupted by each.
        """
        fair = self._waiting.qsize() // (2 * max(self._able, 1))
        wanted = 1 + (min(_AHEAD, fair) if seconds < SHORT else 0)
        if len(taken) > wanted // 2:
            return
        with suppress(queue.Empty):
            while len(taken) < wanted:
                is_idle = self.expects_more and not taken
                taken.append(self._waiting.get(timeout=_IDLE if is_idle else 0))

    def _is_done(self) -> bool:
        """Whether no stage is waiting, so that a worker leaves."""
        with self._lock:
            is_done = self._waiting.empty() and not self.expects_more
            self._able -= is_done
        return is_done

    def _give_up(self, error: UsageError, *stages: _Stage) -> None:
        """Leaves what is waiting to other workers, with the `stages` of one that can't go on.

        Where there are none, what is reported on each stage is why.
        """
        with self._lock:
            for stage in stages:
                self._waiting.put(stage)
            self._able -= 1
            if self._able:
                return
        self._refuse(error)

    def _refuse(self, why: UsageError) -> None:
        """Reports on each stage that waits, or is still to come, why nobody checks it."""
        self._why_not = why
        with suppress(queue.Empty):
            while True:
                path, answer = self._waiting.get_nowait()
                trouble = not_started(str(why))
                self._settle(answer, report_trouble(path, trouble, Status.UNCHECKED))

    def interrupt(self) -> None:
        """Ends the run at once: no stage that is not done yet has a report any more."""
        self._closed = True
        for worker in self._workers:
            worker.kill()
        for answer in tuple(self._unsettled):
            self._settle(answer, None, InterruptedRunError())

    def close(self) -> None:
        """Ends all workers."""
        self._closed = True
        for worker in self._workers:  # all of them, before waiting for any
            worker.kill()
        for worker in self._workers:
            worker.stop()


def _in_a_thread(call: Callable[..., None], *arguments: object) -> None:
    threading.Thread(target=call, args=arguments, daemon=True).start()


def _ready_limit(limit: float) -> float:
    return max(limit, _SHORTEST_READY_LIMIT)
