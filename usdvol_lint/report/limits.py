"""Keeps what is written below the sizes that its readers take."""

from __future__ import annotations

_LONGEST = 2_000


class Room:
    """So many bytes of UTF-8, which texts take up one after the other."""

    def __init__(self, most: int) -> None:
        self.left = most

    def takes(self, text: str, more: int = 0) -> bool:
        """Whether there is room for a text and so many bytes more, which they then take up."""
        size = more + (len(text) if text.isascii() else len(text.encode("utf-8")))
        if size > self.left:
            return False
        self.left -= size
        return True


def cut(text: str, most: int = _LONGEST) -> str:
    """The text, or its beginning and `…`: a name or a message that is longer says no more."""
    return text if len(text) <= most else f"{text[: most - 1]}…"
