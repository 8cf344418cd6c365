"""What a child process writes, read until it ends, even if another process holds its pipe."""

from __future__ import annotations

import io
import os
import select
import selectors
from collections.abc import Callable
from contextlib import suppress
from subprocess import TimeoutExpired
from typing import IO, TYPE_CHECKING, Any

from usdvol_lint.child import kill_group

if TYPE_CHECKING:
    import subprocess

_LOOKS_EVERY = 0.25
"""Seconds after which a child that says nothing is looked after."""


def replies_of(child: subprocess.Popen[bytes]) -> IO[bytes]:
    """The standard output of a child, which ends at the latest when the child does.

    What the child forked holds the pipe open too.  Where nothing forks, it ends with the child.
    """
    assert child.stdout
    return io.BufferedReader(_Output(child)) if os.name == "posix" else child.stdout


def wait_for_end(child: subprocess.Popen[bytes], seconds: float) -> int | None:
    """The exit code of a child that is about to end; None if it has not by then.

    What it started ends with it.
    """
    if child.returncode is None:
        if os.name == "posix" and child.stdout and not child.stdout.closed:
            with _selector(child.stdout) as selector:
                selector.select(seconds)  # to ask again and again whether it has gone takes longer
        with suppress(TimeoutExpired):
            child.wait(seconds)
            kill_group(child)
    return child.returncode


def _selector(pipe: IO[bytes]) -> selectors.BaseSelector:
    """As in `subprocess`: epoll would take a file handle more for each pipe."""
    selector = getattr(selectors, "PollSelector", selectors.SelectSelector)()
    selector.register(pipe, selectors.EVENT_READ)
    return selector


def _looking_at(pipe: IO[bytes]) -> Callable[[float], object]:
    """Whether a pipe has something to read, or has ended, within so many seconds."""
    if not hasattr(select, "poll"):
        return _selector(pipe).select
    poll = select.poll()  # what it has over a selector is that no code of Python's runs
    poll.register(pipe, select.POLLIN)
    return lambda seconds: poll.poll(1000 * seconds)


class _Output(io.RawIOBase):
    def __init__(self, child: subprocess.Popen[bytes]) -> None:
        assert child.stdout
        self._child = child
        self._pipe = child.stdout
        self._is_there = _looking_at(child.stdout)

    def readable(self) -> bool:
        return True

    def readinto(self, buffer: Any) -> int:
        while not self._is_there(_LOOKS_EVERY):
            if self._child.poll() is not None:
                kill_group(self._child)
                if not self._is_there(0):
                    return 0
        return os.readv(self._pipe.fileno(), [buffer])

    def close(self) -> None:
        super().close()
        self._pipe.close()
