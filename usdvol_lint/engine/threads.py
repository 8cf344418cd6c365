"""How many threads USD may use: one for small stages, for which others are woken in vain."""

from __future__ import annotations

from pxr import Work

_LONG = 0.01
"""A stage that takes so many seconds to open is worth the threads; a small one takes 0.5 ms."""
_LONG_AMONG_WORKERS = 0.5
"""The same where other processes have the other processors for their own stages."""


class Threads:
    """The threads of USD: one until all are wanted.

    To compose and to close a stage that is small, USD wakes its other threads, which spin before
    they sleep again: that takes a tenth of the time, and a quarter of the processor's.
    It must be said before USD starts any, and there is no way back from all: they would spin on.
    """

    def __init__(self) -> None:
        self._all = Work.GetConcurrencyLimit()
        self._long = _LONG
        Work.SetConcurrencyLimit(1)

    def begin(self, are_many: bool, workers: int) -> None:
        """Says whether there are many stages, most of them probably small, and for how many."""
        self._long = _LONG if workers == 1 else _LONG_AMONG_WORKERS
        if not are_many:
            self._use_all()

    def opened(self, seconds: float) -> None:
        """Says how long a stage took to open: after a long one USD has all threads."""
        if seconds > self._long:
            self._use_all()

    def _use_all(self) -> None:
        """Lets USD use as many as it may, which the caller's environment can limit."""
        if Work.GetConcurrencyLimit() != self._all:
            Work.SetConcurrencyLimit(self._all)
