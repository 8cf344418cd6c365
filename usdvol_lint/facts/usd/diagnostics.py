"""What USD raises for what it can't read, and the text of it, without the names of its C++."""

from __future__ import annotations

import re
from typing import Any, TypeAlias

from pxr import Tf

from usdvol_lint.model import quoted

UNREADABLE = (Tf.ErrorException, UnicodeDecodeError)
"""What USD raises for what it can't read; the latter for a string that is not valid UTF-8."""

BROKEN_TEXT = "UTF-8"
"""What is part of each message about bytes that are no text, USD's and ours."""
Unreadable: TypeAlias = Tf.ErrorException | UnicodeDecodeError

_UNEXPECTED = r"(?s)parse error matching .*? at '(?P<text>.*)'(?= in <)"


def sayings(error: Unreadable) -> list[str]:
    """What each error says that USD raised at once."""
    if isinstance(error, UnicodeDecodeError):
        return [f"text that is not {BROKEN_TEXT}: {quoted(_decoded(error))}"]
    return list(map(_commentary, error.args))


def _commentary(error: Any) -> str:
    """The message of one `Tf.Error`; it quotes the file, so it need not be valid UTF-8."""
    try:
        return str(error.commentary)
    except UnicodeDecodeError as undecodable:
        return _decoded(undecodable)


def _decoded(undecodable: UnicodeDecodeError) -> str:
    return undecodable.object.decode("utf-8", "backslashreplace")


def without_parser_rule(text: str) -> str:
    """A parse error in one line that says what was unexpected, not which grammar rule failed."""
    return re.sub(_UNEXPECTED, _unexpected, " ".join(text.split()))


def _unexpected(match: re.Match[str]) -> str:
    return f"unexpected '{match['text']}'" if match["text"] else "unexpected end of text"
