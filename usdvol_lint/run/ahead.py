"""Hands the stages of a run to the workers, not too far ahead of the one that is told next."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence
from itertools import islice
from typing import TYPE_CHECKING

from usdvol_lint.model import StageReport
from usdvol_lint.run.pool import Pool

if TYPE_CHECKING:
    from concurrent.futures import Future

MOST_AHEAD = 1000
"""How many stages are looked at while one before them is not done yet."""


class Ahead:
    """Submits the stages of a run in their order, so many at most before the next is done."""

    def __init__(self, pool: Pool, paths: Sequence[str], done: Callable[[], None]) -> None:
        self._pool = pool
        self._done = done
        self._left = iter(paths)
        self._futures: deque[Future[StageReport]] = deque()
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
        return self._futures.popleft().result()

    def _submit(self, path: str) -> None:
        future = self._pool.submit(path)
        future.add_done_callback(lambda _: self._done())
        self._futures.append(future)
