"""A path becomes a Usd.Stage, or a plain reason why it can't."""

from __future__ import annotations

import os
import re
import stat
from pathlib import Path
from typing import Any

from pxr import Sdf, Tf, Usd

from usdvol_lint.facts.files import LFS_SIGNATURE
from usdvol_lint.paths import SUFFIXES
from usdvol_lint.trouble import Unreadable

_CRATE = b"PXR-USDC"
_ZIP = b"PK\x03\x04"
_TEXT = (b"#usda", b"#sdf", b"#usd ")
_ERROR = re.compile(r"Error in '.*?' at line \d+ in file .*? : '(.*?)'\n", re.S)
_PLACE = re.compile(r"^(?P<path>.+?):(?P<line>\d+)(?::(?P<column>\d+))?:\s*(?P<what>.*)", re.S)
_LONGEST = 300


def open_stage(path: str, load: str) -> Any:
    """Opens a stage, without a session layer; raises Unreadable with the reason if it can't."""
    _diagnose(path)
    policy = Usd.Stage.LoadNone if load == "none" else Usd.Stage.LoadAll
    try:
        layer = Sdf.Layer.FindOrOpen(os.path.abspath(path))
        stage = Usd.Stage.Open(layer, None, policy) if layer else None
    except Tf.ErrorException as error:
        raise _explain(path, str(error) + "\n") from error
    if stage is None:
        raise Unreadable("USD can't open this layer and does not say why")
    return stage


def _diagnose(path: str) -> None:
    """Looks at the file before USD does, whose words for these cases are long and unclear."""
    try:
        status = os.stat(path)
    except FileNotFoundError:
        if os.path.islink(path):
            target = os.readlink(path)
            raise Unreadable(f"a symbolic link to {target!r}, which does not exist") from None
        raise Unreadable("no such file or folder") from None
    except OSError as error:
        raise Unreadable(f"can't be read: {error.strerror or error}") from error
    if stat.S_ISDIR(status.st_mode):
        raise Unreadable("a folder that holds no USD file", f"USD files end in {_suffixes()}")
    if not stat.S_ISREG(status.st_mode):
        raise Unreadable("not a regular file (a pipe, socket or device)")
    suffix = Path(path).suffix
    if suffix.lower() not in SUFFIXES:
        raise Unreadable(f"unsupported file type {suffix!r}", f"USD files end in {_suffixes()}")
    try:
        with Path(path).open("rb") as file:
            head = file.read(64)
    except OSError as error:
        raise Unreadable(f"can't be read: {error.strerror or error}") from error
    _diagnose_head(head, status.st_size)


def _diagnose_head(head: bytes, size: int) -> None:
    if not size:
        raise Unreadable("an empty file (0 bytes)", "export it again")
    if head.startswith(LFS_SIGNATURE):
        raise Unreadable("a Git-LFS pointer, not the file itself", "run `git lfs pull`")
    if head.startswith(_CRATE):
        if size < 88:
            raise Unreadable(f"a truncated crate file: {size} bytes, its header alone takes 88")
        contents = int.from_bytes(head[16:24], "little", signed=True)
        if not 0 < contents < size:
            raise Unreadable(
                f"a truncated or corrupt crate file: its table of contents should be at byte "
                f"{contents}, the file has {size} bytes",
                "copy or export it again",
            )
    elif not head.lstrip(b"\xef\xbb\xbf").startswith((_ZIP, *_TEXT)):
        raise Unreadable(f"not a USD file: it begins with {head[:12]!r}")


def _explain(path: str, text: str) -> Unreadable:
    """The first of USD's errors in one line, with its place in the text where it has one."""
    errors = _ERROR.findall(text) or [text]
    first = " ".join(errors[0].split())[:_LONGEST]
    place = _PLACE.match(first)
    if place is None:
        return Unreadable(f"USD can't open it: {first}")
    at_fault = place["path"]
    column = int(place["column"]) if place["column"] else None
    layer = None if os.path.abspath(path) == at_fault else at_fault
    return Unreadable(
        f"parse error: {place['what']}", layer=layer, line=int(place["line"]), column=column
    )


def _suffixes() -> str:
    return ", ".join(SUFFIXES)
