"""USD has one thread until a stage takes long, and then as many as before."""

from __future__ import annotations

import subprocess
import sys

_SCRIPT = """
from pxr import Usd, Work
before = Work.GetConcurrencyLimit()
from usdvol_lint.engine.threads import Threads
threads = Threads()
Usd.Stage.CreateInMemory()
limits = [Work.GetConcurrencyLimit()]
threads.use_all()
print(*limits, Work.GetConcurrencyLimit() == before)
"""


def test_one_thread_until_all_are_wanted() -> None:
    """In a process of its own: there is no way back from many threads."""
    done = subprocess.run(
        [sys.executable, "-P", "-c", _SCRIPT], capture_output=True, text=True, check=True
    )
    assert done.stdout.split() == ["1", "True"]
