"""How many processors this process may use, which in a container are fewer than there are."""

from __future__ import annotations

import os
from collections.abc import Iterator
from math import ceil

from usdvol_lint.run.control_groups import OWN, ROOT, granted

_OLD_NAMES = ("cpu.cfs_quota_us", "cpu.cfs_period_us")


def owned() -> int:
    """The processors that this process may use at once: by its affinity and its control group."""
    count = getattr(os, "process_cpu_count", None)  # since Python 3.13
    affinity = getattr(os, "sched_getaffinity", None)
    found = count() if count else len(affinity(0)) if affinity else os.cpu_count()
    return max(1, min([found or 1, *(ceil(quota) for quota in _quotas())]))


def _quotas(root: str = ROOT, own: str = OWN) -> Iterator[float]:
    """The processors that each control group around this process has, where one is limited."""
    for words in granted("cpu", "cpu.max", _OLD_NAMES, root, own):
        if len(words) == 2 and words[0].isdigit() and words[1].isdigit() and int(words[1]):
            yield int(words[0]) / int(words[1])
