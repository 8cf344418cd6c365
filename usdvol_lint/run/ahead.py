"""Hands the stages of a run to the workers, not too far ahead of the one that is told next."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable, Sequence
from contextlib import suppress
from itertools import islice
from queue import Empty, SimpleQueue

from usdvol_lint.model import StageReport
from usdvol_lint.run.answers import Answer
from usdvol_lint.run.pool import Pool

MOST_AHEAD = 1000
"""How many stages are looked at while one before them is not done yet."""
_PAUSE = 0.02
"""Seconds that a stage which is done may wait to be told: to be woken for each takes longer."""


class Ahead:
    """Submits the stages of a run in their order, so many at most before the next is done."""

    def __init__(self, pool: Pool, paths: Sequence[str], done: Callable[[], None]) -> None:
        self._pool = pool
        self._done = done
        self._left = iter(paths)
        self._answers: deque[Answer] = deque()
        self._lock = threading.RLock()  # a signal may interrupt who has it
        self._unsettled = 0
        self._all_done: SimpleQueue[None] = SimpleQueue()
        pool.expects_more = len(paths) > MOST_AHEAD
        for path in islice(self._left, MOST_AHEAD):
            self._submit(path)

    def next(self) -> StageReport:
        """The report on the next stage, once it is there."""
        path = next(self._left, None)
        if path is None:
            self._pool.expects_more = False
        else:
            self._submit(path)
        answer = self._answers.popleft()
        if not answer.done():
            with suppress(Empty):
                self._all_done.get(timeout=_PAUSE)
        return answer.result()

    def _submit(self, path: str) -> None:
        with self._lock:
            self._unsettled += 1
        answer = self._pool.submit(path)
        self._answers.append(answer)
        answer.add_done_callback(self._settled)

    def _settled(self, answer: Answer) -> None:
        self._done()
        with self._lock:
            self._unsettled -= 1
            is_last = not self._unsettled
        if is_last:
            self._all_done.put(None)
