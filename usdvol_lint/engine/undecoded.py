"""Hears of text that is not UTF-8 for which USD gives None: it tells Python's hook, and goes on."""

from __future__ import annotations

import sys
from types import TracebackType

_MOST = 100


class Undecoded:
    """Meanwhile what USD can't decode is added to the list `heard`, the first of it."""

    def __init__(self) -> None:
        self.heard: list[UnicodeDecodeError] = []

    def __enter__(self) -> Undecoded:
        self._before = sys.excepthook
        sys.excepthook = self._hear
        return self

    def __exit__(self, *_: object) -> None:
        sys.excepthook = self._before

    def _hear(
        self, kind: type[BaseException], error: BaseException, traceback: TracebackType | None
    ) -> None:
        if not isinstance(error, UnicodeDecodeError):
            self._before(kind, error, traceback)
        elif len(self.heard) < _MOST:
            self.heard.append(error)
