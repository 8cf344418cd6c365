"""Hears of text that is not UTF-8 for which USD gives None: it tells Python's hook, and goes on."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from types import TracebackType

_MOST = 100


@contextmanager
def undecoded() -> Iterator[list[UnicodeDecodeError]]:
    """The list that what USD can't decode meanwhile is added to, the first of it."""
    before = sys.excepthook
    heard: list[UnicodeDecodeError] = []

    def hear(
        kind: type[BaseException], error: BaseException, traceback: TracebackType | None
    ) -> None:
        if not isinstance(error, UnicodeDecodeError):
            before(kind, error, traceback)
        elif len(heard) < _MOST:
            heard.append(error)

    sys.excepthook = hear
    try:
        yield heard
    finally:
        sys.excepthook = before
