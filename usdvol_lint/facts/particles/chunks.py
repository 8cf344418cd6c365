"""Reductions over an array in USD's own memory, chunk by chunk, in threads where that pays.

The thread pool is made once for the whole process, when the first large array is reduced.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import cache, reduce
from typing import Any, TypeAlias, TypeVar

import numpy as np

Rows: TypeAlias = np.ndarray[Any, Any]
"""An array of shape (elements, components) and type float16 or float32, or keys or flags of it."""

Row: TypeAlias = tuple[float, ...]
"""One element, or a number for each component."""

_T = TypeVar("_T")

_CHUNK = 1 << 17
"""Numbers in a chunk: one that is read several times has to stay in the CPU cache."""
READ_ONCE = 1 << 20
"""Numbers in a chunk that is read only once."""
_WORTH_THREADS = 1 << 22
"""Numbers in an array from which on threads pay."""
_MOST_THREADS = 8


def rows_of(value: Any) -> Rows:
    """A `VtArray` as a view, without a copy; scalars are elements of one component."""
    array = np.asarray(value)
    return array.reshape(len(array), -1)


def fold(
    rows: Rows,
    measure: Callable[[Rows, int], _T],
    join: Callable[[_T, _T], _T],
    size: int = _CHUNK,
) -> _T:
    """Measures each chunk and joins the results in order.

    `measure` gets the chunk and the index of its first row; `size` is in numbers, not rows.
    """
    step = max(1, size // rows.shape[1])
    starts = range(0, len(rows), step)

    def run(part: range) -> _T:
        with np.errstate(all="ignore"):
            return reduce(join, (measure(rows[start : start + step], start) for start in part))

    threads = _threads()
    if rows.size < _WORTH_THREADS or threads is None:
        return run(starts)
    # More parts than threads, so that one waiting for the disk does not hold up the others.
    share = -(-len(starts) // (8 * _processors()))
    parts = [starts[first : first + share] for first in range(0, len(starts), share)]
    return reduce(join, threads.map(run, parts))


def _processors() -> int:
    """How many threads may run at once; a container may have fewer processors than the machine."""
    affinity = getattr(os, "sched_getaffinity", None)
    owned = len(affinity(0)) if affinity else os.cpu_count() or 1
    return min(owned, _MOST_THREADS)


@cache
def _threads() -> ThreadPoolExecutor | None:
    """The thread pool of the process; None where there is a single processor."""
    return ThreadPoolExecutor(_processors()) if _processors() > 1 else None
