"""How much room texts take in a terminal, and how they are broken into lines."""

from __future__ import annotations

import re
from collections.abc import Iterator

# Text is wrapped between these words; what is in quotes is one, so that a path with spaces can be
# copied.
_WORD = re.compile(r"""(?<!\S)\(?(['"@]).*?\1\S*|\S+""")


def cells(text: str) -> int:
    """How many columns a text takes; wide characters take two."""
    if text.isascii():
        return len(text)
    from rich.cells import cell_len  # costs start-up time

    return cell_len(text)


def wrap(text: str, width: int) -> Iterator[str]:
    """Text in lines of at most `width` columns; a word that is longer has a line of its own."""
    line = ""
    for word in (match.group() for match in _WORD.finditer(text)):
        longer = f"{line} {word}" if line else word
        if line and cells(longer) > width:
            yield line
            line = word
        else:
            line = longer
    yield line
