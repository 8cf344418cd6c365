"""Lists of paths, of a file or standard input: a line each, or NUL between them."""

from __future__ import annotations

import os
import sys

from usdvol_lint.model import UsageError

_BYTE_ORDER_MARK = b"\xef\xbb\xbf"
_MOST_BYTES = 256 << 20
"""A list of a million long paths."""
_OF_UTF_16 = (b"\xff\xfe", b"\xfe\xff")


def read_list(name: str) -> tuple[str, ...]:
    """The paths in a list, in order; `-` is standard input.  Empty lines are passed over."""
    where = f"--files-from {name}"
    data = _bytes(where, name)
    if data.startswith(_OF_UTF_16):
        raise UsageError(f"{where}: this is UTF-16 text, write the list as UTF-8")
    data = data.removeprefix(_BYTE_ORDER_MARK)
    if b"\0" in data:
        paths = data.split(b"\0")
    else:
        paths = [line.removesuffix(b"\r") for line in data.split(b"\n")]
    try:
        return tuple(os.fsdecode(path) for path in paths if path.strip())
    except UnicodeDecodeError as error:  # on Windows, where file names are Unicode
        raise UsageError(f"{where}: not UTF-8 text") from error


def _bytes(where: str, name: str) -> bytes:
    try:
        if name != "-":
            with open(name, "rb") as file:
                data = file.read(_MOST_BYTES + 1)
        elif sys.stdin is None:
            raise UsageError(f"{where}: there is no standard input")
        else:
            data = sys.stdin.buffer.read(_MOST_BYTES + 1)
    except OSError as error:
        raise UsageError(f"{where}: {error.strerror}") from error
    if len(data) > _MOST_BYTES:
        raise UsageError(f"{where}: no list of paths has more than {_MOST_BYTES:,} bytes")
    return data
