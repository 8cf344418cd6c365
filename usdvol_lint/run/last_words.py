"""The end of what a process says on standard error; the rest is read and dropped."""

from __future__ import annotations

import os
import threading
from typing import IO

_CHUNK = 1 << 16
_KEPT = 1 << 16
"""How many bytes are kept, whether or not there are lines in them."""
_LINES = 20
_PATIENCE = 1.0
"""Seconds that the end is waited for: another process may hold the pipe."""


class LastWords:
    """Reads a pipe in a thread of its own until it ends."""

    def __init__(self, stream: IO[bytes]) -> None:
        self._kept = bytearray()
        self._reader = threading.Thread(target=self._read, args=(stream,), daemon=True)
        self._reader.start()

    def _read(self, stream: IO[bytes]) -> None:
        with stream:
            while chunk := os.read(stream.fileno(), _CHUNK):
                self._kept += chunk
                del self._kept[:-_KEPT]

    def text(self) -> str:
        """The last lines, once the process has gone."""
        self._reader.join(_PATIENCE)
        lines = bytes(self._kept).splitlines(keepends=True)[-_LINES:]
        return b"".join(lines).decode("utf-8", "replace").strip()
