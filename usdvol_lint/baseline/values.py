"""JSON text that reviewers and git can read, and its values, each of the type that it has to be."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from usdvol_lint.model import UsageError
from usdvol_lint.words import quoted


def line_of(value: Mapping[str, object]) -> str:
    """The value on one line, without blanks; what is not printable is escaped."""
    text = json.dumps(value, ensure_ascii=False, separators=(",", ":"))
    return text if text.isprintable() else "".join(map(_escaped, text))


def _escaped(char: str) -> str:
    return char if char.isprintable() else json.dumps(char)[1:-1]


def value_of(text: str) -> Any:
    """The value that a text holds; raises ValueError for what is no JSON, in words."""
    try:
        return json.loads(text)
    except json.JSONDecodeError as error:
        line = f"line {error.lineno}, " if "\n" in text.rstrip() else ""
        raise ValueError(f"{error.msg} ({line}column {error.colno})") from None
    except RecursionError:
        raise ValueError("nested too deep") from None
    except ValueError:  # Python converts no number of more than some thousand digits
        raise ValueError("a number of too many digits") from None


def string(where: str, table: Mapping[str, Any], key: str) -> str:
    """The text under a key."""
    value = table.get(key)
    if not isinstance(value, str):
        raise UsageError(f"{where}: {key!r} must be text, {found(table, key)}")
    return value


def optional_string(where: str, table: Mapping[str, Any], key: str) -> str | None:
    """The text under a key; None where there is no such key, or null."""
    return None if table.get(key) is None else string(where, table, key)


def table_of(where: str, table: Mapping[str, Any], key: str) -> dict[str, Any]:
    """The object under a key."""
    value = table.get(key)
    if not isinstance(value, dict):
        raise UsageError(f"{where}: {key!r} must be an object, {found(table, key)}")
    return value


def list_of(where: str, table: Mapping[str, Any], key: str) -> list[Any]:
    """The list under a key."""
    value = table.get(key)
    if not isinstance(value, list):
        raise UsageError(f"{where}: {key!r} must be a list, {found(table, key)}")
    return value


def found(table: Mapping[str, Any], key: str) -> str:
    """The end of a message about a value that is wrong: `not 3`, `and is not there`."""
    if key not in table:
        return "and is not there"
    value = table[key]
    shown = quoted(value) if isinstance(value, str) else repr(value)
    return f"not {shown[:60]}"
