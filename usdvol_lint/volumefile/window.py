"""A part of a regular file, read on demand; nothing outside it is ever read or believed."""

from __future__ import annotations

import os
import stat
from struct import Struct
from typing import Any, NamedTuple

from usdvol_lint.volumefile.model import VolumeFileError

# Opening a FIFO must not block, children must not inherit the descriptor, and Windows must not
# translate line ends.
_FLAGS = os.O_RDONLY | sum(
    getattr(os, name, 0) for name in ("O_NONBLOCK", "O_CLOEXEC", "O_NOINHERIT", "O_BINARY")
)
_CHUNK = 8192
_SMALL = 1 << 15
"""So many bytes at the end of a file are read at once: to ask twice takes longer."""
_MOST_TEXT = 32 << 20
"""In bytes, of all names in a file: no writer writes as many, and they are kept."""
_LENGTH = Struct("<I")


class Note(NamedTuple):
    """What a reader noted about `size` bytes at `position`, for `volumefile.recall`."""

    name: str
    position: int
    size: int


class Window:
    """The bytes `[0, size)` of a volume file, which may lie inside another file.

    Reading starts at `position` and may not pass `limit`, which is `size` unless the caller
    limits it to a section: bytes beyond `size` make a file truncated, beyond `limit` invalid.
    `status` is that of the real file; `notes` are the reader's, `text` is how much of it they keep.
    """

    __slots__ = (
        *("_at", "_base", "_buffer", "_descriptor", "_end", "_start"),
        *("limit", "notes", "position", "size", "status", "text"),
    )

    def __init__(self, descriptor: int, status: os.stat_result, start: int, size: int) -> None:
        """Takes over an open file: leaving the window as a context closes it."""
        self.status = status
        self.notes: list[Note] = []
        self._descriptor = descriptor
        self._start = start
        self._buffer = b""
        self._base = self._end = self._at = 0
        self.size = size
        self.limit = size
        self.position = 0
        self.text = 0

    def __enter__(self) -> Window:
        return self

    def __exit__(self, *_: object) -> None:
        os.close(self._descriptor)

    def _take(self, count: int) -> int:
        """Moves past the next `count` bytes; returns their index in the buffer."""
        end = self.position + count
        if end > self.limit:
            raise self._beyond(end)
        first = self.position - self._base
        if first < 0 or end > self._end:
            self._load(count)
            first = 0
        self.position = end
        return first

    def read(self, count: int) -> bytes:
        """The next `count` bytes; raises VolumeFileError unless there are as many."""
        first = self._take(count)
        return self._buffer[first : first + count]

    def peek(self, count: int) -> bytes:
        """The next `count` bytes, or fewer if the window ends, without moving."""
        here = self.position
        found = self.read(max(0, min(count, self.limit - here)))
        self.position = here
        return found

    def unpack(self, form: Struct) -> tuple[Any, ...]:
        """The next values."""
        first = self._take(form.size)
        return form.unpack_from(self._buffer, first)

    def string(self, longest: int) -> str:
        """A text after its length in 32 bits; bytes that are not UTF-8 become lone surrogates."""
        first = self._take(_LENGTH.size)
        (length,) = _LENGTH.unpack_from(self._buffer, first)
        if length > longest:
            raise VolumeFileError(
                "not-a-volume-file",
                f"text of {length} bytes where at most {longest} make sense",
                self.position - _LENGTH.size,
            )
        self.keep(length)
        return self.read(length).decode("utf-8", "surrogateescape")

    def keep(self, count: int) -> None:
        """Counts what is kept of a file; raises VolumeFileError once that is too much."""
        self.text += count
        if self.text > _MOST_TEXT:
            message = f"more than {_MOST_TEXT >> 20} MiB of names"
            raise VolumeFileError("not-a-volume-file", message, self.position)

    def has_room(self, count: int) -> bool:
        """Whether so much may be kept of what nobody asks for: an eighth of the whole."""
        return self.text + count <= _MOST_TEXT // 8

    def skip(self, count: int) -> None:
        self.require(count)
        self.position += count

    def require(self, count: int) -> None:
        """Raises VolumeFileError unless `count` more bytes follow."""
        if self.position + count > self.limit:
            raise self._beyond(self.position + count)

    def note(self, name: str, size: int) -> None:
        """Notes something about the `size` bytes that were read last."""
        self.notes.append(Note(name, self.position - size, size))

    def _beyond(self, end: int) -> VolumeFileError:
        if end > self.size:
            return VolumeFileError(
                "truncated", f"the file ends at byte {self.size} of at least {end}", self.position
            )
        return VolumeFileError(
            "not-a-volume-file",
            f"the section that ends at byte {self.limit} would go on to byte {end}",
            self.position,
        )

    def _load(self, count: int) -> None:
        left = self.size - self.position
        wanted = left if left <= _SMALL else min(max(count, _CHUNK), left)
        try:
            if self._start + self.position != self._at:
                os.lseek(self._descriptor, self._start + self.position, os.SEEK_SET)
            found = os.read(self._descriptor, wanted)
            while len(found) < wanted and (more := os.read(self._descriptor, wanted - len(found))):
                found += more
        except OSError as error:
            raise VolumeFileError("not-a-file", _words(error), self.position) from None
        self._buffer = found
        self._base = self.position
        self._end = self._base + len(self._buffer)
        self._at = self._start + self._end
        if self._end < self._base + count:
            self.size = self.limit = self._end
            raise self._beyond(self._base + count)


def open_window(path: str, offset: int, size: int | None) -> Window:
    """The `size` bytes of a file from `offset` on, or fewer if the file ends.

    Raises VolumeFileError for a file that can't be opened or is not a regular one.
    """
    try:
        descriptor = os.open(path, _FLAGS)
    except (OSError, ValueError) as error:
        raise VolumeFileError("not-a-file", _words(error)) from None
    try:
        status = os.fstat(descriptor)
        if stat.S_ISDIR(status.st_mode):
            raise VolumeFileError("not-a-file", "a folder")
        if not stat.S_ISREG(status.st_mode):
            raise VolumeFileError("not-a-file", "not a regular file")
        if offset > status.st_size:
            message = f"the file ends at byte {status.st_size}, before byte {offset}"
            raise VolumeFileError("truncated", message)
    except BaseException:
        os.close(descriptor)
        raise
    there = status.st_size - offset
    return Window(descriptor, status, offset, there if size is None else min(size, there))


def _words(error: OSError | ValueError) -> str:
    text = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
    return text.lower()
