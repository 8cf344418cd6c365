"""What a stage comes to, for which somebody may wait."""

from __future__ import annotations

from collections.abc import Callable
from queue import SimpleQueue
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from usdvol_lint.model import StageReport


class Answer:
    """A future that has a lock only where somebody waits for it, which is for few stages.

    `settle` is called once.  It says that it is done before it looks for a waiter, and `result`
    says that it waits before it looks once more: one of them finds the other.
    """

    __slots__ = ("_calls", "_error", "_is_done", "_report", "_waiter")

    def __init__(self) -> None:
        self._is_done = False
        self._report: StageReport | None = None
        self._error: Exception | None = None
        self._waiter: SimpleQueue[None] | None = None
        self._calls: list[Callable[[Answer], object]] = []

    def done(self) -> bool:
        """Whether it is settled."""
        return self._is_done

    def add_done_callback(self, call: Callable[[Answer], object]) -> None:
        """Has this called once it is settled, in the thread that does so, or now."""
        self._calls.append(call)
        if self._is_done:
            self._tell()

    def settle(self, report: StageReport | None, error: Exception | None = None) -> None:
        """Gives it the report, or what is raised in its place."""
        self._report, self._error = report, error
        self._is_done = True
        if self._waiter:
            self._waiter.put(None)
        self._tell()

    def result(self) -> StageReport:
        """The report, once it is there."""
        if not self._is_done:
            waiter: SimpleQueue[None] = SimpleQueue()
            self._waiter = waiter
            if not self._is_done:
                waiter.get()
        if self._error:
            raise self._error
        assert self._report
        return self._report

    def _tell(self) -> None:
        while self._calls:
            try:
                call = self._calls.pop()
            except IndexError:  # the other thread was sooner
                return
            call(self)
