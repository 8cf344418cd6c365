"""What the text of a layer is made of: strings, comments, asset paths and what is between them."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import NamedTuple

# The lexical elements in which brackets and separators have no meaning.  None of them can fail to
# match once it has begun (the closing mark is optional) and none backtracks, so that the time is
# linear for any text.
BLOCK_COMMENT = rb"/\*[^*]*+(?:\*(?!/)[^*]*+)*+(?:\*/)?+"
COMMENTS = (rb"#[^\n]*+", rb"//[^\n]*+", BLOCK_COMMENT)
STRINGS = (
    rb'"""[^"\\]*+(?:(?:\\[\s\S]|"(?!""))[^"\\]*+)*+(?:""")?+',
    rb"'''[^'\\]*+(?:(?:\\[\s\S]|'(?!''))[^'\\]*+)*+(?:''')?+",
    rb'"[^"\\\r\n]*+(?:\\[^\r\n][^"\\\r\n]*+)*+"?+',
    rb"'[^'\\\r\n]*+(?:\\[^\r\n][^'\\\r\n]*+)*+'?+",
)
ASSETS = (
    rb"@@@[^@\\\r\n]*+(?:(?:\\@@@|\\|@(?!@@))[^@\\\r\n]*+)*+(?:@{3,5})?+",
    rb"@[^@\r\n]*+@?+",
)
PATHS = (rb"<[^<>\r\n]*+>?+",)
OPAQUE = (*STRINGS, *ASSETS, *COMMENTS, *PATHS)


def either(*patterns: bytes) -> bytes:
    return b"(?:" + b"|".join(patterns) + b")"


def runs(plain: bytes, *others: bytes) -> bytes:
    """As much as there is of plain bytes, a class, and of other patterns, few of which stand there.

    `re` takes the plain ones in one step, and a step for each of the others.
    """
    return plain + b"*+(?:" + either(*others) + plain + b"*+)*+"


STRING = either(*STRINGS)
SPACE = either(rb"[ \t]++", BLOCK_COMMENT)
PADDING = runs(rb"[ \t\n\r\f\v;]", *COMMENTS)
NAMED = SPACE + rb"++(?:[^\s\"'(){}=;,/]++" + SPACE + b"++)?+" + STRING
BRACE_VALUE = b"=" + SPACE + rb"*+\{"


def tokens(*marked: bytes, plain: Iterable[bytes] = ()) -> re.Pattern[bytes]:
    """A pattern to search with; `lastindex` of a match is which of `marked` it is, from 1.

    The alternatives have to begin with a literal, so that `re` skips the bytes between two tokens
    by table look-up: hence their (empty) groups at the end.
    """
    return re.compile(b"|".join([*(pattern + b"()" for pattern in marked), *plain]))


class Span(NamedTuple):
    start: int
    stop: int


def unquoted(literal: bytes) -> str:
    """A string without its marks."""
    marks = 3 if literal.startswith((b'"""', b"'''")) else 1
    return literal[marks:-marks].decode("utf-8", "replace")
