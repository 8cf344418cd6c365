"""Reductions over an array where USD has it in memory, in chunks that stay in the CPU cache.

Large arrays are shared among threads, which the process starts once and keeps.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import cache, reduce
from typing import Any, TypeAlias, TypeVar

import numpy as np

Rows: TypeAlias = np.ndarray[Any, Any]
"""An array of vectors as a view of two dimensions; numbers are vectors of one."""

Row: TypeAlias = tuple[float, ...]

_T = TypeVar("_T")

_CHUNK = 1 << 17
"""How many numbers in a chunk: one that is read several times has to stay in the cache."""
READ_ONCE = 1 << 20
"""How many where each chunk is read only once."""
_WORTH_THREADS = 1 << 22
"""How many numbers in an array, before threads pay."""
_MOST_THREADS = 8


def rows_of(value: Any) -> Rows:
    """A VtArray as a view, without a copy."""
    array = np.asarray(value)
    return array.reshape(len(array), -1)


def fold(
    rows: Rows,
    measure: Callable[[Rows, int], _T],
    join: Callable[[_T, _T], _T],
    size: int = _CHUNK,
) -> _T:
    """What `measure` says of each chunk, which is told where it begins, joined in their order."""
    step = max(1, size // rows.shape[1])
    starts = range(0, len(rows), step)

    def run(part: range) -> _T:
        with np.errstate(all="ignore"):
            return reduce(join, (measure(rows[start : start + step], start) for start in part))

    threads = _threads()
    if rows.size < _WORTH_THREADS or threads is None:
        return run(starts)
    # More parts than threads: one that has to wait for the disk does not hold up the others.
    share = -(-len(starts) // (8 * _processors()))
    parts = [starts[first : first + share] for first in range(0, len(starts), share)]
    return reduce(join, threads.map(run, parts))


def _processors() -> int:
    """How many threads may run at once: a container may own fewer processors than the machine."""
    affinity = getattr(os, "sched_getaffinity", None)
    owned = len(affinity(0)) if affinity else os.cpu_count() or 1
    return min(owned, _MOST_THREADS)


@cache
def _threads() -> ThreadPoolExecutor | None:
    return ThreadPoolExecutor(_processors()) if _processors() > 1 else None
