"""A progress bar on standard error, for runs that take long enough."""

from __future__ import annotations

import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from types import TracebackType
from typing import Any

from usdvol_lint.words import printable

_MANY_AHEAD = 20
"""So many stages are done before the one that they wait for, and it is named."""
_START_DELAY = 0.7
"""Seconds before the bar is shown: shorter runs don't import rich."""


class ProgressBar:
    """Counts stages, and the samples of long sequences, and names the stage that others wait for.

    Its methods are thread-safe, and a signal may interrupt them.
    """

    def __init__(self, enabled: bool) -> None:
        self._enabled = enabled
        self._began = time.monotonic()
        self._lock = threading.RLock()
        self._bar: Any = None
        self._task: Any = None
        self._stages = 0
        self._done = 0
        self._samples = 0
        self._awaited = ""
        self._number = 0

    def __enter__(self) -> ProgressBar:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def close(self) -> None:
        """Takes the bar away."""
        with self._lock:
            self._enabled = False
            if self._bar:
                self._bar.stop()

    def begin(self, stages: int) -> None:
        self._stages = stages

    def stage_done(self) -> None:
        if not self._enabled:
            return
        with self._lock:
            self._done += 1
            self._show()

    def advance(self, samples: int) -> None:
        with self._lock:
            self._samples += samples
            self._show()

    def awaits(self, path: str, number: int) -> None:
        """Says which stage is told next, and how many were before it."""
        if not self._enabled:
            return
        with self._lock:
            self._awaited, self._number = path, number

    @contextmanager
    def aside(self) -> Iterator[None]:
        """Leaves the terminal to what is printed meanwhile."""
        bar = self._bar if sys.stdout is not None and sys.stdout.isatty() else None
        if bar:
            bar.stop()
        try:
            yield
        finally:
            if bar and self._enabled:
                bar.start()

    def _waiting(self) -> str:
        """The stage for which all that is done after it waits; empty where it is not worth it."""
        ahead = self._done - self._number
        is_last = ahead and self._done + 1 == self._stages
        return (
            f", waiting for {printable(self._awaited)}" if ahead >= _MANY_AHEAD or is_last else ""
        )

    def _show(self) -> None:
        if not self._enabled or time.monotonic() - self._began < _START_DELAY:
            return
        if self._stages < 2 and not self._samples:
            return
        if self._bar is None:
            self._open()
        said = f"{self._samples:,} samples{self._waiting()}"
        self._bar.update(self._task, completed=self._done, said=said)

    def _open(self) -> None:
        from rich.console import Console
        from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn

        self._bar = Progress(
            TextColumn("checking"),
            BarColumn(),
            MofNCompleteColumn(),
            TextColumn("stages, {task.fields[said]}", markup=False),
            console=Console(stderr=True),
            transient=True,
        )
        self._bar.start()
        self._task = self._bar.add_task("", total=self._stages, said="")
