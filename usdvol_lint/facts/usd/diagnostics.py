"""The text of errors that USD raises, without the names of its C++ functions."""

from __future__ import annotations

import re
from typing import Any

from pxr import Tf

UNREADABLE = (Tf.ErrorException, UnicodeDecodeError)
"""What USD raises for what it can't read; the latter for a string that is not valid UTF-8."""

_UNEXPECTED = r"(?s)parse error matching .*? at '(?P<text>.*)'(?= in <)"


def commentary(error: Any) -> str:
    """The message of one `Tf.Error`; it quotes the file, so it need not be valid UTF-8."""
    try:
        return str(error.commentary)
    except UnicodeDecodeError as undecodable:
        return str(undecodable.object.decode("utf-8", "backslashreplace"))


def without_parser_rule(text: str) -> str:
    """A parse error in one line that says what was unexpected, not which grammar rule failed."""
    return re.sub(_UNEXPECTED, _unexpected, " ".join(text.split()))


def _unexpected(match: re.Match[str]) -> str:
    return f"unexpected '{match['text']}'" if match["text"] else "unexpected end of text"
