"""What USD says in its errors, without the names of its C++."""

from __future__ import annotations

import re
from typing import Any

from pxr import Tf

UNREADABLE = (Tf.ErrorException, UnicodeDecodeError)
"""What USD raises for what it can't read: a string that is no text reaches Python as the latter."""

_UNEXPECTED = r"(?s)parse error matching .*? at '(?P<text>.*)'(?= in <)"


def commentary(error: Any) -> str:
    """What one of USD's errors says, which need not be text, because it quotes the file."""
    try:
        return str(error.commentary)
    except UnicodeDecodeError as undecodable:
        return str(undecodable.object.decode("utf-8", "backslashreplace"))


def without_parser_rule(text: str) -> str:
    """A parse error that says what was unexpected, not which rule of USD's grammar missed it."""
    return re.sub(_UNEXPECTED, _unexpected, " ".join(text.split()))


def _unexpected(match: re.Match[str]) -> str:
    return f"unexpected '{match['text']}'" if match["text"] else "unexpected end of text"
