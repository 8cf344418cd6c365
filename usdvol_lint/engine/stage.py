"""A path becomes a Usd.Stage, or a plain reason why it can't."""

from __future__ import annotations

import os
import re
import stat
from typing import Any, BinaryIO

from pxr import Sdf, Tf, Usd

from usdvol_lint.engine.trouble import Unreadable
from usdvol_lint.facts.usd.clips import tells_of_clips
from usdvol_lint.facts.usd.diagnostics import commentary, without_parser_rule
from usdvol_lint.model import quoted
from usdvol_lint.paths import SUFFIXES, display
from usdvol_lint.volumefile.signatures import LFS_POINTER

_CRATE = b"PXR-USDC"
_ZIP = b"PK\x03\x04"
_ZIP_ENTRY = b"PK\x01\x02"
_ZIP_END = b"PK\x05\x06"
_ZIP_END_SIZE = 22
_ZIP_END_LONGEST = _ZIP_END_SIZE + 0xFFFF
_ZIP64 = 0xFFFFFFFF
_TEXT = (b"#usda", b"#sdf", b"#usd ")
_BYTE_ORDER_MARK = b"\xef\xbb\xbf"
_CRATE_HEADER = 88
_HOLDS = (
    (_CRATE, "a crate file", (".usdc", ".usd")),
    (_ZIP, "a zip file", (".usdz",)),
    (_TEXT, "USD text", (".usda", ".usd")),
)
"""What a file can begin with, what it is then, and the names under which USD reads that."""
# Few stages fail, so what takes their errors apart is compiled only then.
_SESSION = r", sessionLayer @anon:[^@]*@"
_MENTION = r"[@<]([^@<>]+)[@>]"
_PLACE = r"(?s)(?P<path>.+?):(?P<line>\d+)(?::(?P<column>\d+))?:\s*(?P<what>.*)"
_LONGEST = 300
_EXPORT_AGAIN = "copy or export it again"


def open_stage(path: str, load: str, session: Any | None = None) -> Any:
    """Opens a stage, as a rule without a session layer; raises Unreadable with the reason."""
    head = _diagnose(path)
    policy = Usd.Stage.LoadNone if load == "none" else Usd.Stage.LoadAll
    try:
        layer = Sdf.Layer.FindOrOpen(os.path.abspath(path))
        stage = _open(layer, session, policy) if layer else None
    except Tf.ErrorException as error:
        raise _explain(path, messages(error), head) from error
    if stage is None and head.startswith(_ZIP):
        raise Unreadable("a package in which USD finds no layer to open", "package it again")
    if stage is None:
        raise Unreadable("USD can't open this layer and does not say why")
    return stage


def _open(layer: Any, session: Any | None, policy: Any) -> Any:
    """The stage of a root layer, also where USD raises for value clips that do not open.

    It makes a manifest for clips without one, and so opens them with the stage: the stage is whole
    then, but only to be had from the cache.
    """
    cache = Usd.StageCache()
    try:
        with Usd.StageCacheContext(cache):
            return Usd.Stage.Open(layer, session, policy)
    except Tf.ErrorException as error:
        stage = next(iter(cache.GetAllStages()), None)
        if stage is None or not tells_of_clips(error, stage):
            raise
        return stage


def _diagnose(path: str) -> bytes:
    """Looks at the file before USD does, whose words for these cases are long and unclear.

    Returns how the file begins.
    """
    try:
        status = os.stat(path)
    except FileNotFoundError:
        if os.path.islink(path):
            target = os.readlink(path)
            raise Unreadable(f"a symbolic link to {quoted(target)}, which does not exist") from None
        raise Unreadable("no such file or folder") from None
    except OSError as error:
        raise Unreadable(f"can't be read: {error.strerror or error}") from error
    if stat.S_ISDIR(status.st_mode):
        raise _diagnose_folder(path)
    if not stat.S_ISREG(status.st_mode):
        raise Unreadable("not a regular file (a pipe, socket or device)")
    suffix = os.path.splitext(path)[1].lower()
    if suffix not in SUFFIXES:
        what = f"unsupported file type {suffix!r}" if suffix else "a file name without an extension"
        raise Unreadable(what, f"USD files end in {_suffixes()}")
    if not _is_unicode(os.path.abspath(path)):
        raise Unreadable("USD opens no file whose path is not UTF-8", "rename the file or folder")
    try:
        with open(path, "rb") as file:
            head = file.read(64)
            is_whole = not head.startswith(_ZIP) or _has_directory(file)
    except OSError as error:
        raise Unreadable(f"can't be read: {error.strerror or error}") from error
    _diagnose_head(head, status.st_size, suffix)
    if not is_whole:
        raise Unreadable(
            "a truncated or corrupt package: the directory of its files, which ends it, is missing",
            "copy or package it again",
        )
    return head


def _diagnose_folder(path: str) -> Unreadable:
    try:
        os.listdir(path)
    except OSError as error:
        return Unreadable(f"can't be read: {error.strerror or error}")
    return Unreadable("a folder that holds no USD file", f"USD files end in {_suffixes()}")


def _diagnose_head(head: bytes, size: int, suffix: str) -> None:
    if not size:
        raise Unreadable("an empty file (0 bytes)", "export it again")
    if head.startswith(LFS_POINTER):
        raise Unreadable("a Git-LFS pointer, not the file itself", "run `git lfs pull`")
    if head.startswith(_BYTE_ORDER_MARK):
        raise Unreadable(
            "begins with a byte order mark, which USD does not read", "save it as UTF-8 without one"
        )
    if _CRATE.startswith(head[:8]) and size < _CRATE_HEADER:
        raise Unreadable(
            f"a truncated crate file: {size} bytes, its header alone takes {_CRATE_HEADER}",
            _EXPORT_AGAIN,
        )
    for signature, what, suffixes in _HOLDS:
        if head.startswith(signature):
            if suffix not in suffixes:
                names = " or ".join(suffixes)
                raise Unreadable(f"{what} under the name of a {suffix}", f"rename it to {names}")
            break
    else:
        raise Unreadable(f"not a USD file: it begins with {head[:12]!r}")
    if head.startswith(_CRATE):
        contents = int.from_bytes(head[16:24], "little", signed=True)
        if not 0 < contents < size:
            raise Unreadable(
                f"a truncated or corrupt crate file: its table of contents should be at byte "
                f"{contents}, the file has {size} bytes",
                _EXPORT_AGAIN,
            )


def _has_directory(package: BinaryIO) -> bool:
    """Whether a zip file names its directory at its end, and has it where it says.

    USD may open one without, because it goes from file to file; hardly anything else does.
    """
    size = package.seek(0, os.SEEK_END)
    start = max(size - _ZIP_END_LONGEST, 0)
    package.seek(start)
    tail = package.read(_ZIP_END_LONGEST)
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


def _explain(path: str, errors: list[str], head: bytes) -> Unreadable:
    """One of USD's errors in one line: the first that has a place in the text, or the first."""
    lines = [_in_one_line(path, error) for error in errors]
    place = next(filter(None, (re.match(_PLACE, line) for line in lines)), None)
    if place:
        at_fault = place["path"]
        return Unreadable(
            f"parse error: {place['what']}"[:_LONGEST],
            layer=None if os.path.abspath(path) == at_fault else at_fault,
            line=int(place["line"]),
            column=int(place["column"]) if place["column"] else None,
        )
    first = lines[0] if lines else "no reason given"
    if head.startswith(_CRATE):
        return Unreadable(f"a truncated or corrupt crate file: {first}"[:_LONGEST], _EXPORT_AGAIN)
    return Unreadable(f"USD can't open it: {first}"[:_LONGEST])


def _in_one_line(path: str, error: str) -> str:
    """An error of USD's without the path that the finding names anyway, and without C++."""
    for mention in (f", while reading {display(path)}", "Encountered: "):
        error = error.replace(mention, "")
    return without_parser_rule(error)


def messages(error: Any) -> list[str]:
    """What the errors in a `Tf.ErrorException` say."""
    return [_commentary(each) for each in error.args]


def _commentary(error: Any) -> str:
    """Files are named as findings name them."""
    return re.sub(_MENTION, _shown, re.sub(_SESSION, "", commentary(error)))


def _shown(mention: re.Match[str]) -> str:
    return display(mention[1]) if os.path.isfile(mention[1]) else mention[0]


def _is_unicode(text: str) -> bool:
    try:
        text.encode()
    except UnicodeEncodeError:
        return False
    return True


def _suffixes() -> str:
    return ", ".join(SUFFIXES)
