"""Starts a worker process; imports little, because a run does this before anything else."""

from __future__ import annotations

import os
import subprocess
import sys

_PROGRAM = "import sys; sys.path[:] = {path!r}; from usdvol_lint.run.worker import main; main()"
"""A worker has the `sys.path` of its parent: `-c` would put the working directory first."""


def _path() -> list[str]:
    """The `sys.path` of this process, with the folder that this package was imported from."""
    own = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    return sys.path if own in sys.path else [*sys.path, own]


def start_child() -> subprocess.Popen[bytes]:
    """A process that runs `usdvol_lint.run.worker`: it imports USD, then waits for messages."""
    return subprocess.Popen(
        [sys.executable, "-c", _PROGRAM.format(path=_path())],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )
