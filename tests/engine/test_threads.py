"""USD has one thread until a stage takes long, and then as many as before."""

from __future__ import annotations

import subprocess
import sys

import pytest

_SCRIPT = """
import sys
from pxr import Usd, Work
before = Work.GetConcurrencyLimit()
from usdvol_lint.engine.threads import Threads
threads = Threads()
are_many, workers, seconds = eval(sys.argv[1])
threads.begin(are_many, workers)
Usd.Stage.CreateInMemory()
threads.opened(seconds)
print("all" if Work.GetConcurrencyLimit() == before else Work.GetConcurrencyLimit())
"""


@pytest.mark.parametrize(
    ("are_many", "workers", "seconds", "threads"),
    [
        (True, 1, 0.001, "1"),
        (True, 1, 0.2, "all"),
        (True, 2, 0.2, "1"),
        (True, 2, 1.0, "all"),
        (False, 2, 0.0, "all"),
    ],
)
def test_one_thread_until_all_are_wanted(
    are_many: bool, workers: int, seconds: float, threads: str
) -> None:
    """In a process of its own, where there is a second thread: there is no way back from many."""
    asked = repr((are_many, workers, seconds))
    done = subprocess.run(
        [sys.executable, "-P", "-c", _SCRIPT, asked], capture_output=True, text=True, check=True
    )
    assert done.stdout.split() == [threads]
