"""A progress bar on standard error, for runs that take long enough."""

from __future__ import annotations

import threading
import time
from types import TracebackType
from typing import Any

_START_DELAY = 0.7
"""Seconds before the bar is shown: shorter runs don't import rich."""


class ProgressBar:
    """Counts stages, and the samples of long sequences; its methods are thread-safe."""

    def __init__(self, enabled: bool) -> None:
        self._enabled = enabled
        self._began = time.monotonic()
        self._lock = threading.Lock()
        self._bar: Any = None
        self._task: Any = None
        self._stages = 0
        self._done = 0
        self._samples = 0

    def __enter__(self) -> ProgressBar:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        with self._lock:
            self._enabled = False
            if self._bar:
                self._bar.stop()

    def begin(self, stages: int) -> None:
        self._stages = stages

    def stage_done(self) -> None:
        with self._lock:
            self._done += 1
            self._show()

    def advance(self, samples: int) -> None:
        with self._lock:
            self._samples += samples
            self._show()

    def _show(self) -> None:
        if not self._enabled or time.monotonic() - self._began < _START_DELAY:
            return
        if self._stages < 2 and not self._samples:
            return
        if self._bar is None:
            self._open()
        self._bar.update(self._task, completed=self._done, samples=f"{self._samples:,} samples")

    def _open(self) -> None:
        from rich.console import Console
        from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn

        self._bar = Progress(
            TextColumn("checking"),
            BarColumn(),
            MofNCompleteColumn(),
            TextColumn("stages, {task.fields[samples]}"),
            console=Console(stderr=True),
            transient=True,
        )
        self._bar.start()
        self._task = self._bar.add_task("", total=self._stages, samples="")
