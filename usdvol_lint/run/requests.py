"""What the parent asks of a worker, read in a thread of its own."""

from __future__ import annotations

import os
import pickle
import threading
from queue import SimpleQueue
from typing import Any, BinaryIO


class Requests:
    """The messages in a pipe, in their order.

    Once the pipe has ended nobody waits for an answer any more, so the process ends at once, even
    if it is busy.
    """

    def __init__(self, pipe: BinaryIO) -> None:
        self._pipe = pipe
        self._read: SimpleQueue[Any] = SimpleQueue()
        self._reads_on = True
        try:
            threading.Thread(target=self._read_on, daemon=True).start()
        except RuntimeError:  # no threads left: it ends once it has answered
            self._reads_on = False

    def next(self) -> Any:
        """The next message, as soon as it is there."""
        if not self._reads_on and self._read.empty():
            self._load()
        message = self._read.get()
        if isinstance(message, Exception):
            raise message
        return message

    def more(self, most: int) -> list[Any]:
        """So many messages at most, of those that are there already."""
        messages: list[Any] = []
        while len(messages) < most and not self._read.empty():
            messages.append(self.next())
        return messages

    def _load(self) -> None:
        try:
            messages = pickle.load(self._pipe)
        except (EOFError, OSError):
            os._exit(0)
        except Exception as error:  # raised where it is asked for
            messages = (error,)
        for message in messages:
            self._read.put(message)

    def _read_on(self) -> None:
        while True:
            self._load()
