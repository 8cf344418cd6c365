"""Starts a worker process; imports little, because a run does this before anything else."""

from __future__ import annotations

import subprocess
import sys

_PROGRAM = "import sys; sys.path[:] = {path!r}; from usdvol_lint.run.worker import main; main()"
"""A worker has the `sys.path` of its parent: `-c` would put the working directory first."""


def start_child() -> subprocess.Popen[bytes]:
    """A process that runs `usdvol_lint.run.worker`: it imports USD, then waits for messages."""
    return subprocess.Popen(
        [sys.executable, "-c", _PROGRAM.format(path=sys.path)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )
