"""What USD raises for what it can't read, and the text of it, without the names of its C++."""

from __future__ import annotations

import re
from types import TracebackType
from typing import Any, TypeAlias

from pxr import Tf

from usdvol_lint.words import quoted

UNREADABLE = (Tf.ErrorException, UnicodeDecodeError)
"""What USD raises for what it can't read; the latter for a string that is not valid UTF-8."""

BROKEN_TEXT = "UTF-8"
"""What is part of each message about bytes that are no text, USD's and ours."""
Unreadable: TypeAlias = Tf.ErrorException | UnicodeDecodeError

_UNEXPECTED = r"(?s)parse error matching .*? at '(?P<text>.*)'(?= in <)"


_CODECS = ("codecs", "encodings")
"""Python's own modules that decode: where a text file is read, it is they that raise."""


def is_by_usd(error: BaseException) -> bool:
    """Whether USD may have raised it: its C++ has no frame, and decodes nothing but UTF-8."""
    if not isinstance(error, UnicodeDecodeError):
        return isinstance(error, UNREADABLE)
    entry = innermost(error)
    module = str(entry.tb_frame.f_globals.get("__name__")) if entry else ""
    return error.encoding == "utf-8" and module.partition(".")[0] not in _CODECS


def innermost(error: BaseException) -> TracebackType | None:
    """Where Python raised it, or called what raised it."""
    entry = error.__traceback__
    while entry and entry.tb_next:
        entry = entry.tb_next
    return entry


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
