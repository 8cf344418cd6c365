"""Lists of paths, of a file or standard input: a line each, or NUL between them."""

from __future__ import annotations

import os
import sys

from usdvol_lint.model import UsageError

_BYTE_ORDER_MARK = b"\xef\xbb\xbf"
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
    if name == "-":
        if sys.stdin is None:
            raise UsageError(f"{where}: there is no standard input")
        return sys.stdin.buffer.read()
    try:
        with open(name, "rb") as file:
            return file.read()
    except OSError as error:
        raise UsageError(f"{where}: {error.strerror}") from error
