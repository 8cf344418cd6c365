"""The line of a text that a position is in, as much of it as a report can show."""

from __future__ import annotations

from usdvol_lint.model import Excerpt

_LONGEST = 160
_LOOKED_AT = 4 * _LONGEST
"""So many bytes after the mark have as many characters as are shown."""
_BEFORE = 60
"""How many characters before the mark are shown where a line is too long to be shown whole."""
_MORE = "…"
_SPACE = ord(" ")


def excerpt(data: bytes, start: int, offset: int) -> Excerpt:
    """The line that begins at `start`, and the column of `offset` in what is shown of it."""
    end = data.find(b"\n", offset, offset + _LOOKED_AT)
    line = data[start:end]
    if 0 <= end <= start + _LONGEST and line.isascii() and data[offset] > _SPACE:  # nearly always
        text = line.decode("ascii").lstrip()
        return Excerpt(text.rstrip("\r"), offset - end + len(text) + 1)
    before = data[start:offset].decode("utf-8", "replace").removeprefix("\ufeff").lstrip()
    after = data[offset : end if end >= 0 else offset + _LOOKED_AT].decode("utf-8", "replace")
    after = after.rstrip("\r")
    if len(before) + len(after) > _LONGEST:
        before, after = _cut(before, after)
    return Excerpt(before + after, len(before) + 1)


def _cut(before: str, after: str) -> tuple[str, str]:
    """As much of what stands before and after a mark as is shown of a long line."""
    if len(before) > _BEFORE:
        before = _MORE + before[-_BEFORE:]
    room = _LONGEST - len(before)
    return before, after if len(after) <= room else after[: room - 1] + _MORE
