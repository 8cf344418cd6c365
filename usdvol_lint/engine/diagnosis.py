"""Why a file can't be a stage, seen before USD opens it."""

from __future__ import annotations

import os
import stat
from typing import BinaryIO

from usdvol_lint.engine.trouble import Trouble, UnreadableStageError
from usdvol_lint.layertext.signatures import TEXT_SIGNATURES
from usdvol_lint.paths import SUFFIXES
from usdvol_lint.volumefile.signatures import LFS_POINTER
from usdvol_lint.words import quoted

CRATE_SIGNATURE = b"PXR-USDC"
ZIP_SIGNATURE = b"PK\x03\x04"
EXPORT_AGAIN = "copy or export it again"
_FORMATS = (
    (CRATE_SIGNATURE, "a crate file", (".usdc", ".usd")),
    (ZIP_SIGNATURE, "a zip file", (".usdz",)),
    (TEXT_SIGNATURES, "USD text", (".usda", ".usd")),
)
"""What a file can begin with, what it is then, and the suffixes under which USD reads that."""
_TEXT_SUFFIX = ".usda"
_BYTE_ORDER_MARK = b"\xef\xbb\xbf"
_HEAD_SIZE = 64
_CRATE_HEADER_SIZE = 88
_ZIP_ENTRY = b"PK\x01\x02"
_ZIP_END = b"PK\x05\x06"
_ZIP_END_SIZE = 22
_LONGEST_ZIP_END = _ZIP_END_SIZE + 0xFFFF
"""The record that ends a zip file is followed by a comment of up to 65,535 bytes."""
_ZIP64 = 0xFFFFFFFF


def look_at(path: str) -> bytes | None:
    """The first bytes of a file that USD may be able to open; None of a text.

    Raises UnreadableStageError for a file that it can't: USD's own messages for these cases are
    long and unclear.  Text is safe to try, and `read_head` tells what else a file is that failed.
    """
    status = _status(path)
    trouble = _trouble_with_kind(path, status.st_mode) or _trouble_with_name(path)
    if trouble:
        raise UnreadableStageError(trouble)
    return None if path.endswith(_TEXT_SUFFIX) else _read_head(path, status)


def read_head(path: str) -> bytes:
    """The first bytes of a file that USD failed to open; raises as `look_at` does."""
    return _read_head(path, _status(path))


def _read_head(path: str, status: os.stat_result) -> bytes:
    try:
        with open(path, "rb") as file:
            head = file.read(_HEAD_SIZE)
            is_whole = not head.startswith(ZIP_SIGNATURE) or _has_directory(file)
    except OSError as error:
        raise UnreadableStageError(_denied(error)) from error
    suffix = os.path.splitext(path)[1].lower()
    trouble = _trouble_with_head(head, status.st_size, suffix)
    if not trouble and not is_whole:
        trouble = Trouble(
            "a truncated or corrupt package: the directory of its files, which ends it, is missing",
            "copy or package it again",
        )
    if trouble:
        raise UnreadableStageError(trouble)
    return head


def _status(path: str) -> os.stat_result:
    try:
        return os.stat(path)
    except FileNotFoundError:
        trouble = Trouble(
            "no such file or folder",
            "correct the path: a pattern that matches nothing stays as it is",
        )
        if os.path.islink(path):
            target = quoted(os.readlink(path))
            trouble = Trouble(
                f"a symbolic link to {target}, which does not exist",
                "restore that file, or remove the link",
            )
        raise UnreadableStageError(trouble) from None
    except OSError as error:
        raise UnreadableStageError(_denied(error)) from error


def _denied(error: OSError) -> Trouble:
    return Trouble(f"can't be read: {error.strerror or error}")


def _trouble_with_kind(path: str, mode: int) -> Trouble | None:
    if stat.S_ISDIR(mode):
        try:
            os.listdir(path)
        except OSError as error:
            return _denied(error)
        return Trouble("a folder that holds no USD file", f"USD files end in {_suffixes()}")
    if not stat.S_ISREG(mode):
        return Trouble("not a regular file (a pipe, socket or device)", "name a file")
    return None


def _trouble_with_name(path: str) -> Trouble | None:
    suffix = os.path.splitext(path)[1].lower()
    if suffix not in SUFFIXES:
        what = f"unsupported file type {suffix!r}" if suffix else "a file name without an extension"
        return Trouble(what, f"USD files end in {_suffixes()}")
    if not _is_unicode(os.path.abspath(path)):
        return Trouble("USD opens no file whose path is not UTF-8", "rename the file or folder")
    return None


def _trouble_with_head(head: bytes, size: int, suffix: str) -> Trouble | None:
    if not size:
        return Trouble("an empty file (0 bytes)", "export it again")
    if head.startswith(LFS_POINTER):
        return Trouble("a Git-LFS pointer, not the file itself", "run `git lfs pull`")
    if head.startswith(_BYTE_ORDER_MARK):
        return Trouble(
            "begins with a byte order mark, which USD does not read", "save it as UTF-8 without one"
        )
    if CRATE_SIGNATURE.startswith(head[:8]) and size < _CRATE_HEADER_SIZE:
        return Trouble(
            f"a truncated crate file: {size} bytes, its header alone takes {_CRATE_HEADER_SIZE}",
            EXPORT_AGAIN,
        )
    return _trouble_with_format(head, suffix) or _trouble_with_crate(head, size)


def _trouble_with_format(head: bytes, suffix: str) -> Trouble | None:
    for signature, what, suffixes in _FORMATS:
        if head.startswith(signature):
            if suffix in suffixes:
                return None
            names = " or ".join(suffixes)
            return Trouble(f"{what} under the name of a {suffix}", f"rename it to {names}")
    return Trouble(f"not a USD file: it begins with {head[:12]!r}", EXPORT_AGAIN)


def _trouble_with_crate(head: bytes, size: int) -> Trouble | None:
    if not head.startswith(CRATE_SIGNATURE):
        return None
    contents = int.from_bytes(head[16:24], "little", signed=True)
    if 0 < contents < size:
        return None
    return Trouble(
        "a truncated or corrupt crate file: its table of contents should be at byte "
        f"{contents}, the file has {size} bytes",
        EXPORT_AGAIN,
    )


def _has_directory(package: BinaryIO) -> bool:
    """Whether a zip file names its directory at its end, and has it where it says.

    USD may open one without, because it goes from file to file; hardly any other program does.
    """
    size = package.seek(0, os.SEEK_END)
    start = max(size - _LONGEST_ZIP_END, 0)
    package.seek(start)
    tail = package.read(_LONGEST_ZIP_END)
    at = len(tail)
    # What looks like the record may be part of a comment, or of a package inside of this one.
    while (at := tail.rfind(_ZIP_END, 0, at)) >= 0:
        record = tail[at : at + _ZIP_END_SIZE]
        length, offset = (int.from_bytes(record[i : i + 4], "little") for i in (12, 16))
        if len(record) < _ZIP_END_SIZE:
            continue
        if _ZIP64 in (length, offset):
            return True
        if offset + length <= start + at:
            package.seek(offset)
            if package.read(4) == _ZIP_ENTRY:
                return True
    return False


def _is_unicode(text: str) -> bool:
    try:
        text.encode()
    except UnicodeEncodeError:
        return False
    return True


def _suffixes() -> str:
    return ", ".join(SUFFIXES)
