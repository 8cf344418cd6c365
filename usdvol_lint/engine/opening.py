"""Looks at stages that take long to open, and ends that where USD would compose without end."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any, NamedTuple

from usdvol_lint.engine.trouble import Trouble, report_trouble
from usdvol_lint.model import StageReport
from usdvol_lint.words import counted

if TYPE_CHECKING:
    from usdvol_lint.engine.composing import Size

_LOOKS_EVERY = 2.0
"""Seconds between two looks: only a stage that both find opening is looked at."""
_MOST_SITES = 50_000_000
"""So many places in layer stacks, of all prims together, take USD 25 gigabytes, and ten minutes.

A stage of a million prims has a few million of them.
"""


class _Opening(NamedTuple):
    """A root layer that USD makes a stage of, and how."""

    path: str
    layer: Any
    session: Any | None
    loads: bool


class Watch:
    """Looks at stages that take long to open, in a thread of its own.

    `end` is called there with the report on a stage that is not to be opened, and does not return.
    """

    def __init__(self, end: Callable[[StageReport], None]) -> None:
        self._end = end
        self._opening: _Opening | None = None
        self._lock = threading.Lock()
        with suppress(RuntimeError):  # no threads left: the limits of the run hold
            threading.Thread(target=self._look_on, daemon=True).start()

    @contextmanager
    def opening(self, path: str, layer: Any, session: Any | None, loads: bool) -> Iterator[None]:
        """Meanwhile USD makes a stage of a layer."""
        self._opening = _Opening(path, layer, session, loads)
        try:
            yield
        finally:
            with self._lock:
                self._opening = None

    def _look_on(self) -> None:
        before = None
        while True:
            time.sleep(_LOOKS_EVERY)
            opening = self._opening
            if opening and opening is before:
                with suppress(Exception):  # what can't be counted may be opened all the same
                    self._look(opening)
            before = opening

    def _look(self, opening: _Opening) -> None:
        from usdvol_lint.engine.composing import size_of  # few stages take so long

        path, layer, session, loads = opening
        size = size_of(layer, session, loads, lambda: self._opening is opening)
        with self._lock:
            if size.sites > _MOST_SITES and self._opening is opening:
                self._end(report_trouble(path, _multiplied(size)))


def _multiplied(size: Size) -> Trouble:
    below = f", many of them below prims such as <{size.again}>" if size.again else ""
    return Trouble(
        "not opened: its arcs multiply what they bring: "
        f"the same {size.different:,} prims again and again, {counted(size.prims)} in all{below}",
        "let each level bring the one below once, or make the prims that bring it instanceable: "
        "what instances share is composed once",
    )
