"""Signals that end a run before its time: what was found until then is still reported."""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable
from types import FrameType, TracebackType
from typing import Any

_ENDING = tuple(getattr(signal, name) for name in ("SIGINT", "SIGTERM") if hasattr(signal, name))


class Interruption:
    """While it is entered, the first signal calls what `stops` the run, any other one ends it.

    `number` is that of the signal, 0 until there is one.
    Where nothing stops the run yet, a signal raises KeyboardInterrupt with its number.
    """

    def __init__(self) -> None:
        self.number = 0
        self._stop: Callable[[], None] | None = None
        self._before: dict[int, Any] = {}

    def stops(self, stop: Callable[[], None] | None) -> None:
        """Says what a signal is to call; it must not block."""
        self._stop = stop

    def __enter__(self) -> Interruption:
        if threading.current_thread() is threading.main_thread():
            for number in _ENDING:
                # What is ignored, as under nohup, stays so.
                if signal.getsignal(number) is not signal.SIG_IGN:
                    self._before[number] = signal.signal(number, self._hear)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        for number, handler in self._before.items():
            signal.signal(number, handler)

    def _hear(self, number: int, frame: FrameType | None) -> None:
        stop, self._stop = self._stop, None
        self.number = number
        if stop is None:
            raise KeyboardInterrupt(number)
        stop()
