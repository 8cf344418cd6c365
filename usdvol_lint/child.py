"""Starts a worker process; imports little, because a run does this before anything else."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from contextlib import suppress

_PROGRAM = "import sys; sys.path[:] = {path!r}; from usdvol_lint.run.worker import main; main()"
"""A worker has the `sys.path` of its parent: `-c` would put the working directory first."""
_HAS_GROUPS = os.name == "posix"


def _path() -> list[str]:
    """The `sys.path` of this process, with the folder that this package was imported from."""
    own = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    return sys.path if own in sys.path else [*sys.path, own]


def start_child() -> subprocess.Popen[bytes]:
    """A process that runs `usdvol_lint.run.worker`: it imports USD, then waits for messages.

    It leads a group of its own, so that it can be ended with what it starts.
    """
    return subprocess.Popen(
        [sys.executable, "-c", _PROGRAM.format(path=_path())],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        process_group=0 if _HAS_GROUPS else -1,
    )


def kill_child(child: subprocess.Popen[bytes]) -> None:
    """Ends a child at once with what it started; one that was waited for is let alone."""
    if child.returncode is None:
        kill_group(child)
        child.kill()


def kill_group(child: subprocess.Popen[bytes]) -> None:
    """Ends what a child started that has just gone: its number may be another process's later."""
    if _HAS_GROUPS:
        with suppress(ProcessLookupError, PermissionError):
            os.killpg(child.pid, signal.SIGKILL)
