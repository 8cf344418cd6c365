"""Writes the parts of a text as they come, to standard output or in the place of a file."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

from usdvol_lint.model import UsageError
from usdvol_lint.replacing import replacing


class Printer:
    """Prints text as it comes; what can't be printed is said once all of it came."""

    def __init__(self) -> None:
        self._why_not = "" if sys.stdout else "there is no standard output to print to"
        self._is_over = sys.stdout is None

    def print(self, parts: Iterable[str]) -> None:
        if self._is_over or sys.stdout is None:
            return
        try:
            sys.stdout.flush()
            _write(sys.stdout.buffer, parts)
            sys.stdout.buffer.flush()
        except OSError as error:
            # What is left in the buffer must not fail again when Python exits.
            os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
            self._is_over = True
            # A reader that closed the pipe, as `head` does, is no failure.
            if not isinstance(error, BrokenPipeError):
                self._why_not = f"can't write to standard output: {error.strerror}"

    def close(self) -> None:
        """Raises UsageError where not all was printed."""
        if self._why_not:
            raise UsageError(self._why_not)


@contextmanager
def write_to(file: Path) -> Iterator[Callable[[Iterable[str]], None]]:
    """What takes the parts of a text for a file, which is replaced once all are there."""
    with open(file, "wb", 0) if is_device(file) else replacing(file) as stream:
        yield lambda parts: _write(stream, parts)


def _write(file: BinaryIO, parts: Iterable[str]) -> None:
    file.writelines(part.encode("utf-8", "backslashreplace") for part in parts)


def is_device(file: Path) -> bool:
    """Whether it exists but is no regular file, such as /dev/null or a pipe."""
    return os.path.exists(file) and not os.path.isfile(file)
