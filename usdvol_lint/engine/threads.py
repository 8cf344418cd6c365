"""How many threads USD may use: one for small stages, for which others are woken in vain."""

from __future__ import annotations

from pxr import Work


class Threads:
    """The threads of USD: one until all are wanted.

    To compose and to close a stage that is small, USD wakes its other threads, which spin before
    they sleep again: that takes a tenth of the time, and a quarter of the processor's.
    It must be said before USD starts any, and there is no way back from all: they would spin on.
    """

    def __init__(self) -> None:
        self._all = Work.GetConcurrencyLimit()
        Work.SetConcurrencyLimit(1)

    def use_all(self) -> None:
        """Lets USD use as many as it may, which the caller's environment can limit."""
        if Work.GetConcurrencyLimit() != self._all:
            Work.SetConcurrencyLimit(self._all)
