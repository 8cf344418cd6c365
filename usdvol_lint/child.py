"""Starts a child process; in a module of its own, because that is the first thing a run does."""

from __future__ import annotations

import subprocess
import sys

_PROGRAM = "import sys; sys.path[:] = {path!r}; from usdvol_lint.run.worker import main; main()"
"""A worker imports from where its parent does, and nothing else from the working directory."""


def start_child() -> subprocess.Popen[bytes]:
    """A process that runs `usdvol_lint.run.worker`: it imports USD, then waits for messages."""
    return subprocess.Popen(
        [sys.executable, "-c", _PROGRAM.format(path=sys.path)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )
