"""Signals that end a run before its time: what was found until then is still reported."""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Callable
from contextlib import suppress
from stat import S_ISCHR
from types import FrameType

_ENDING = ("SIGINT", "SIGTERM", "SIGHUP")
"""Ctrl-C, the end of a job, a terminal that is closed; not every system has all of them."""
_PATIENCE = 1.0
"""Seconds after which a second signal means that the end takes too long."""
_STUCK = 3.0
"""Seconds without work after which nobody reads what is written, as of a pipe without a reader."""
_WORKS = 0.01
"""Seconds of the processor's that are work."""
_ENDED = 128


class Interruption:
    """What signals do: the first one ends the run, at a time that leaves nothing half done.

    While it is held, as it is at first, that is later, when it is released or the work is done.
    Else what `stops` the run is called, or KeyboardInterrupt with the number of the signal raised.
    A second signal does nothing unless it is late, so that no report is cut off; a third one does,
    and so does the first where writing makes no progress after it.
    `number` is that of the first signal, 0 until there is one; `is_early` says that stages were
    left out for it.
    """

    def __init__(self) -> None:
        self.number = 0
        self.is_early = False
        self._heard = 0
        self._first_at = 0.0
        self._worked = 0.0
        self._is_held = True
        self._stop: Callable[[], None] | None = None

    def listen(self) -> None:
        """Hears the signals from now on; what is ignored, as under nohup, stays so."""
        for number in (getattr(signal, name) for name in _ENDING if hasattr(signal, name)):
            if signal.getsignal(number) is not signal.SIG_IGN:
                signal.signal(number, self._hear)

    def hold(self) -> None:
        """Lets what follows be finished."""
        self._is_held, self._stop = True, None

    def release(self) -> None:
        """Lets signals raise KeyboardInterrupt, also one that was heard before."""
        self._is_held = False
        if self.number:
            raise KeyboardInterrupt(self.number)

    def stops(self, stop: Callable[[], None]) -> None:
        """Says what a signal is to call; it must not block."""
        self._stop = stop

    def _hear(self, number: int, frame: FrameType | None) -> None:
        self._heard += 1
        if self._heard == 1:
            self._hear_first(number)
        elif self._heard > 3:
            os._exit(_ENDED + self.number)
        elif self._heard == 3 or time.monotonic() - self._first_at > _PATIENCE:
            self._heard = 3
            raise KeyboardInterrupt(self.number)

    def _hear_first(self, number: int) -> None:
        self.number, self._first_at = number, time.monotonic()
        self._watch()
        if name_of(number) == "SIGHUP":
            _leave_terminal()
        if self._stop:
            self._stop()
        elif not self._is_held:
            raise KeyboardInterrupt(number)

    def _watch(self) -> None:
        """Looks from time to time whether something is still done, where the system can wake us."""
        if hasattr(signal, "setitimer"):
            self._worked = time.process_time()
            signal.signal(signal.SIGALRM, self._look)
            signal.setitimer(signal.ITIMER_REAL, _STUCK, _STUCK)

    def _look(self, number: int, frame: FrameType | None) -> None:
        worked = time.process_time()
        if worked - self._worked < _WORKS:
            raise KeyboardInterrupt(self.number)
        self._worked = worked


def name_of(number: int) -> str:
    """What a signal is called."""
    return signal.Signals(number).name


def _leave_terminal() -> None:
    """Puts the null device in the place of a terminal that is closed, which takes no more text."""
    for number in (1, 2):
        with suppress(OSError):
            if S_ISCHR(os.fstat(number).st_mode) and not os.isatty(number):
                os.dup2(os.open(os.devnull, os.O_WRONLY), number)
