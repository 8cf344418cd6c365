"""`python -m bench.gauges GAUGE LINTER…` runs the linter and prints one figure of that run."""

from __future__ import annotations

import math
import re
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path

_INTERVAL = 0.002


def check(words: list[str]) -> tuple[float, int]:
    """The seconds that a worker spent on facts and rules, without opening and walking a stage."""
    done = subprocess.run([*words, "--verbose"], stdout=subprocess.PIPE, text=True, check=False)
    match = re.search(r"^ *seconds:.*\bcheck ([0-9.]+)", done.stdout, re.MULTILINE)
    return float(match[1]) if match else math.nan, done.returncode


def memory(words: list[str]) -> tuple[float, int]:
    """The most anonymous memory that a process had, in megabytes; mapped files do not count."""
    process = subprocess.Popen(words, stdout=subprocess.DEVNULL)
    most = 0
    while process.poll() is None:
        most = max(most, *map(_anonymous_kilobytes, _family(process.pid)), 0)
        time.sleep(_INTERVAL)
    return most / 1000, process.returncode


def _family(process: int) -> Iterator[int]:
    """The ids of a process and its descendants; on Linux only."""
    yield process
    with suppress(OSError):
        for children in Path(f"/proc/{process}/task").glob("*/children"):
            for child in children.read_text().split():
                yield from _family(int(child))


def _anonymous_kilobytes(process: int) -> int:
    with suppress(OSError):
        for line in Path(f"/proc/{process}/status").read_text().splitlines():
            if line.startswith("RssAnon:"):
                return int(line.split()[1])
    return 0


GAUGES: dict[str, Callable[[list[str]], tuple[float, int]]] = {"check": check, "memory": memory}

if __name__ == "__main__":
    figure, exit_code = GAUGES[sys.argv[1]](sys.argv[2:])
    print(figure)
    sys.exit(exit_code)
