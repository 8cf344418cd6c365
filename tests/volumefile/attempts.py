"""Attempts to read bytes: what is refused, in how much memory, and with any byte changed."""

from __future__ import annotations

import tracemalloc
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from usdvol_lint.volumefile import VolumeFile, VolumeFileError, read_volume_file

Reader = Callable[[bytes], VolumeFile]


def refusal(read: Reader, content: bytes) -> VolumeFileError:
    with pytest.raises(VolumeFileError) as caught:
        read(content)
    return caught.value


def refusal_of_file(path: Path | str, offset: int = 0, size: int | None = None) -> VolumeFileError:
    with pytest.raises(VolumeFileError) as caught:
        read_volume_file(str(path), offset, size)
    return caught.value


def outcome(
    path: str, offset: int = 0, size: int | None = None
) -> tuple[str | None, VolumeFile | None]:
    """The error's code, if there is one, and what was understood."""
    try:
        return None, read_volume_file(path, offset, size)
    except VolumeFileError as error:
        words = str(error)
        words.encode()
        return error.code if len(words) < 1000 else words, error.partial


@contextmanager
def memory_below(limit: int) -> Iterator[None]:
    """Fails if Python's objects take as many bytes at any moment."""
    tracemalloc.start()
    try:
        yield
        assert tracemalloc.get_traced_memory()[1] < limit
    finally:
        tracemalloc.stop()


def with_each_byte_changed(whole: bytes, path: Path) -> Iterator[int]:
    """Where in a file each copy of the bytes begins of which one is at an extreme."""
    for byte in (b"\0", b"\x7f", b"\xff"):
        path.write_bytes(b"".join(whole[:at] + byte + whole[at + 1 :] for at in range(len(whole))))
        yield from range(0, len(whole) ** 2, len(whole))
