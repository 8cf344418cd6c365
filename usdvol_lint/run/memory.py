"""What a process keeps in memory for itself, and how much of that one worker may keep."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from typing import Any

from usdvol_lint.config.values import bytes_of
from usdvol_lint.run.control_groups import OWN, ROOT, granted
from usdvol_lint.run.limits import address_space

_SHARE = 0.8
"""How much of what there is all workers may keep together."""
_GROWTH = 400 << 20
"""So much more than it had at first is a lot: USD never frees the names that it has met."""


class Memory:
    """The memory of one process as the others see it, against its limit.

    psutil is imported when it is first measured, which most runs don't live to see.
    """

    def __init__(self, limit: str = "auto", jobs: int = 1) -> None:
        self.own = 0
        self._said, self._jobs = limit, jobs
        self._limit: float | None = None
        self._least: int | None = None
        self._process: Any = None

    def begin(self) -> None:
        """Forgets the process that was measured: another one takes its place."""
        self._process = self._least = None

    @property
    def limit(self) -> float:
        """How many bytes the process may keep; infinite if any number."""
        if self._limit is None:
            said = bytes_of(self._said)
            self._limit = _share(self._jobs) if said is None else said or float("inf")
        return self._limit

    @property
    def is_chosen(self) -> bool:
        """Whether somebody asked for the limit."""
        return self._said != "auto"

    def is_too_large(self, pid: int) -> bool:
        """Whether a process keeps more than the limit now; its memory is `own` then."""
        self.own = self._measured(pid)
        if self.own:
            self._least = min(self._least or self.own, self.own)
        return self.own > self.limit

    def has_grown(self, pid: int) -> bool:
        """Whether a process keeps a lot more than when it was small; measured only if it seems so.

        What one stage takes is freed after it.
        """
        if not self._is_great():
            return False
        self.own = self._measured(pid)
        return self._is_great()

    def _is_great(self) -> bool:
        if self._least is None:
            return False
        return self.own - self._least > min(_GROWTH, max(self.limit - self._least, 0) / 2)

    def _measured(self, pid: int) -> int:
        """The bytes that a process keeps resident and shares with nobody; 0 if that is not known.

        What is mapped from a file, such as a crate, is there once, whoever maps it.
        """
        try:
            import psutil
        except (ImportError, OSError, MemoryError):  # no file handles or memory left
            return 0
        try:
            self._process = self._process or psutil.Process(pid)
            return own_part(self._process.memory_info(), pid)
        except (psutil.Error, OSError):  # it has gone
            self._process = None
            return 0


def own_part(measured: Any, pid: int) -> int:
    """What of the memory of a process is its own, as its operating system tells that."""
    resident: int = measured.rss
    if hasattr(measured, "shared"):
        return resident - int(measured.shared)
    if hasattr(measured, "private"):
        return min(resident, int(measured.private))
    return _footprint(pid) or resident if sys.platform == "darwin" else resident


def _footprint(pid: int) -> int:
    """What the Activity Monitor of macOS shows as the memory of a process; 0 if not known."""
    import ctypes

    usage = (ctypes.c_uint64 * 64)()
    try:
        libproc = ctypes.CDLL("/usr/lib/libproc.dylib")
        failed = libproc.proc_pid_rusage(pid, 0, ctypes.byref(usage))
    except (OSError, AttributeError):
        return 0
    return 0 if failed else int(usage[9])  # ri_phys_footprint of a rusage_info_v0


def _share(jobs: int) -> float:
    """What each of so many workers may keep."""
    return _SHARE * min([*(each / jobs for each in _common()), address_space() or float("inf")])


def _common(root: str = ROOT, own: str = OWN) -> Iterator[float]:
    """What all workers have together: by the machine, and by each control group around them."""
    try:
        import psutil

        yield psutil.virtual_memory().total
    except (ImportError, OSError, RuntimeError):
        yield float("inf")
    for words in granted("memory", "memory.max", ("memory.limit_in_bytes",), root, own):
        if len(words) == 1 and words[0].isdigit():
            yield int(words[0])
