"""A time limit that begins anew for each stage, and a look at the memory, in one thread."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable

_UNLIMITED = float("inf")
_LOOKS_EVERY = 0.25
"""Seconds between two looks: a process can hardly take more than half a gigabyte meanwhile."""
_FEW_SECONDS = 1.0
"""In so short a time only a stage that takes long is looked at."""


class Deadline:
    """Calls `expire` once the limit has passed; a thread for each stage would take longer than it.

    `is_expired` says whether that was so since the limit was set.
    `is_too_large` is asked now and then while the time runs, and ends it as the limit does, but
    with `is_over`.
    """

    def __init__(
        self, expire: Callable[[], None], is_too_large: Callable[[], bool] | None = None
    ) -> None:
        self.is_expired = False
        self.is_over = False
        self._expire = expire
        self._is_too_large = is_too_large
        self._at = _UNLIMITED
        self._number = 0
        self._met = 0
        self._looks = True
        self._looks_from = 0.0
        self._is_closed = False
        self._lock = threading.Lock()
        self._changed = threading.Condition(self._lock)
        self._thread: threading.Thread | None = None
        self._wakes_at = _UNLIMITED

    def start(self) -> None:
        """Starts the thread, if need be; raises RuntimeError where there can't be one more."""
        if self._thread is None:
            thread = threading.Thread(target=self._watch, daemon=True)
            thread.start()
            self._thread = thread

    def set(self, seconds: float, looks: bool = True) -> None:
        """Lets the time run from now on; unless it `looks`, nothing is asked meanwhile."""
        self.start()
        now = time.monotonic()
        self._looks = looks
        if looks:
            self._looks_from = self._looks_from or now + _FEW_SECONDS
        self.is_expired = self.is_over = False
        with self._lock:
            self._number += 1
            self._at = now + seconds
            if self._at < self._wakes_at:
                self._changed.notify()

    def move(self, seconds: float) -> None:
        """Lets the time run anew, unless it is over: for the same stage, or several at once."""
        with self._lock:
            if self._at != _UNLIMITED:
                self._at = time.monotonic() + seconds
                if self._at < self._wakes_at:
                    self._changed.notify()

    def clear(self) -> None:
        """Stops the time: whether it is expired does not change any more."""
        with self._lock:  # the thread notices once it wakes
            self._at = _UNLIMITED

    def close(self) -> None:
        """Ends the thread."""
        with self._changed:
            self._is_closed = True
            self._changed.notify()

    def _watch(self) -> None:
        with self._changed:
            while not self._is_closed:
                left = self._at - time.monotonic()
                if left <= 0:
                    self.is_expired = True
                    self._end()
                    continue
                left = min(left, _LOOKS_EVERY) if self._is_too_large else left
                self._wakes_at = time.monotonic() + left
                # What wakes it early is another limit.
                if not self._changed.wait(None if left == _UNLIMITED else left):
                    self._look()

    def _look(self) -> None:
        """Ends what has become too large, unless it is done by the time that this is known."""
        number = self._number
        is_long, self._met = number == self._met, number
        if self._at == _UNLIMITED or not self._is_too_large or not self._looks:
            return
        if not is_long and time.monotonic() < self._looks_from:
            return
        self._changed.release()  # nobody waits for this
        try:
            is_too_large = self._is_too_large()
        finally:
            self._changed.acquire()
        if is_too_large and number == self._number and self._at != _UNLIMITED:
            self.is_over = True
            self._end()

    def _end(self) -> None:
        self._at = _UNLIMITED
        self._expire()
