"""The line of a text that a position is in, as much of it as a report can show."""

from __future__ import annotations

from usdvol_lint.model import Excerpt

_LONGEST = 160
_BEFORE = 60
"""How many characters before the mark are shown where a line is too long to be shown whole."""
_MORE = "…"


def excerpt(data: bytes, start: int, offset: int) -> Excerpt:
    """The line that begins at `start`, and the column of `offset` in what is shown of it."""
    end = data.find(b"\n", offset, offset + 4 * _LONGEST)
    before = data[start:offset].decode("utf-8", "replace").removeprefix("\ufeff")
    after = data[offset : end if end >= 0 else offset + 4 * _LONGEST].decode("utf-8", "replace")
    after = after.rstrip("\r")
    indent = len(before) - len(before.lstrip())
    before = before[indent:]
    if len(before) + len(after) > _LONGEST and len(before) > _BEFORE:
        before = _MORE + before[-_BEFORE:]
    room = _LONGEST - len(before)
    if len(after) > room:
        after = after[: room - 1] + _MORE
    return Excerpt(before + after, len(before) + 1)
