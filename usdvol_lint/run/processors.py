"""How many processors this process may use, which in a container are fewer than there are."""

from __future__ import annotations

import os
from collections.abc import Iterator
from math import ceil

_ROOT = "/sys/fs/cgroup"


def owned() -> int:
    """The processors that this process may use at once: by its affinity and its control group."""
    count = getattr(os, "process_cpu_count", None)  # since Python 3.13
    affinity = getattr(os, "sched_getaffinity", None)
    found = count() if count else len(affinity(0)) if affinity else os.cpu_count()
    return max(1, min([found or 1, *(ceil(quota) for quota in _quotas())]))


def _quotas(root: str = _ROOT, own: str = "/proc/self/cgroup") -> Iterator[float]:
    """The processors that each control group around this process has, where one is limited."""
    for line in _text(own).splitlines():
        _, controllers, path = line.split(":", 2)
        if not controllers:
            yield from _limits(root, path, "cpu.max")
        elif "cpu" in controllers.split(","):
            yield from _limits(f"{root}/{controllers}", path, "cpu.cfs_quota_us")


def _limits(root: str, path: str, name: str) -> Iterator[float]:
    """What a group and those above it say; in a container only the outermost may be there."""
    while True:
        words = _text(f"{root}{path}/{name}").split()
        if len(words) == 1:  # of version 1, where the period is in a file of its own
            words += _text(f"{root}{path}/cpu.cfs_period_us").split()
        if len(words) == 2 and words[0].isdigit() and words[1].isdigit() and int(words[1]):
            yield int(words[0]) / int(words[1])
        if not path.strip("/"):
            return
        path = path.rpartition("/")[0]


def _text(path: str) -> str:
    try:
        with open(path, encoding="utf-8", errors="replace") as file:
            return file.read()
    except OSError:
        return ""
