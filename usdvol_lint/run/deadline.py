"""A time limit that begins anew for each stage, kept by one thread for all of them."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable

_UNLIMITED = float("inf")


class Deadline:
    """Calls `expire` once the limit has passed; a thread for each stage would take longer than it.

    `is_expired` says whether that was so since the limit was set.
    """

    def __init__(self, expire: Callable[[], None]) -> None:
        self.is_expired = False
        self._expire = expire
        self._at = _UNLIMITED
        self._changed = threading.Condition()
        self._thread: threading.Thread | None = None
        self._wakes_at = _UNLIMITED

    def set(self, seconds: float) -> None:
        """Lets the time run from now on."""
        self.is_expired = False
        with self._changed:
            self._at = time.monotonic() + seconds
            if self._thread is None:
                self._thread = threading.Thread(target=self._watch, daemon=True)
                self._thread.start()
            elif self._at < self._wakes_at:
                self._changed.notify()

    def clear(self) -> None:
        """Stops the time: whether it is expired does not change any more."""
        with self._changed:  # the thread notices once it wakes
            self._at = _UNLIMITED

    def _watch(self) -> None:
        with self._changed:
            while True:
                left = self._at - time.monotonic()
                if left <= 0:
                    self._at = _UNLIMITED
                    self.is_expired = True
                    self._expire()
                    continue
                self._wakes_at = self._at
                self._changed.wait(None if left == _UNLIMITED else left)
