"""Worker processes that share a queue of stages."""

from __future__ import annotations

import queue
import threading
import time
from collections.abc import Callable
from concurrent.futures import Future, InvalidStateError
from contextlib import suppress
from typing import TYPE_CHECKING

from usdvol_lint.model import StageReport, UsageError
from usdvol_lint.run.protocol import Setup
from usdvol_lint.run.supervisor import Worker

if TYPE_CHECKING:
    import subprocess

_START_DELAY = 0.3
"""Seconds before each further worker starts: about what it spends on importing USD."""
_SHORTEST_READY_LIMIT = 60.0
"""Seconds that a worker has at least to import USD and load the rules."""


class InterruptedRunError(Exception):
    """What a stage has in place of a report where the run ended before it."""


class Pool:
    """Workers behind the interface of an executor: `submit` gives a Future of a StageReport.

    The first worker starts at once, unless its child process is given; others start only while
    stages are waiting.
    """

    def __init__(self, child: subprocess.Popen[bytes] | None = None) -> None:
        self._first = Worker(child)
        self._waiting: queue.SimpleQueue[tuple[str, Future[StageReport]]] = queue.SimpleQueue()
        self._workers: list[Worker] = [self._first]
        self._closed = False
        self._submitted: list[Future[StageReport]] = []

    @property
    def usd_version(self) -> str:
        return self._first.usd_version

    def submit(self, path: str) -> Future[StageReport]:
        """Queues a stage; nothing happens to it before `run`."""
        future: Future[StageReport] = Future()
        self._submitted.append(future)
        self._waiting.put((path, future))
        return future

    def run(
        self,
        setup: Setup,
        jobs: int,
        limit: float,
        advance: Callable[[int], None] = lambda samples: None,
    ) -> None:
        """Starts to work the queue off with at most `jobs` workers, in threads; does not wait.

        `limit` are the seconds that one stage may take; a future holds what its stage came to.
        Raises UsageError if the first worker can't work.
        """
        self._first.prepare(setup, _ready_limit(limit))
        workers = min(jobs, self._waiting.qsize())
        _in_a_thread(self._work_off, self._first, limit, advance)
        for number in range(1, workers):
            _in_a_thread(self._join_later, number, setup, limit, advance)

    def _join_later(
        self, number: int, setup: Setup, limit: float, advance: Callable[[int], None]
    ) -> None:
        time.sleep(_START_DELAY * number)
        if self._waiting.empty() or self._closed:
            return
        worker = Worker()
        self._workers.append(worker)
        try:
            worker.prepare(setup, _ready_limit(limit))
        except UsageError:  # the others do its work, or did it and ended the run
            return
        self._work_off(worker, limit, advance)

    def _work_off(self, worker: Worker, limit: float, advance: Callable[[int], None]) -> None:
        while not self._closed:
            try:
                path, future = self._waiting.get_nowait()
            except queue.Empty:
                return
            with suppress(InvalidStateError):  # of a run that was interrupted
                try:
                    report = worker.lint(path, limit, advance)
                except Exception as error:  # raised again where the result is asked for
                    future.set_exception(error)
                else:
                    future.set_result(report)

    def interrupt(self) -> None:
        """Ends the run at once: no stage that is not done yet has a report any more."""
        self._closed = True
        for worker in self._workers:
            worker.kill()
        for future in self._submitted:
            with suppress(InvalidStateError):  # of those that are done
                future.set_exception(InterruptedRunError())

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
