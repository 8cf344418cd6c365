"""Where each setting is said, so that messages can name the file and the key, or the option."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

_TABLES = frozenset({"severity", "options"})


class Origin(NamedTuple):
    """Where something is said: how messages name that, and the file; None if it is in none."""

    words: str
    file: str | None = None


class Origins(NamedTuple):
    """Where the settings of a run are said.

    `files` are the configuration file and those that it extends, each after the one that names it.
    `said` has the origins by key and entry: an item of a list, a key of a table, `rule.option`, or
    "" for the setting itself.
    """

    files: tuple[str, ...] = ()
    said: Mapping[tuple[str, str], Origin] = {}

    def of(self, key: str, entry: str = "") -> Origin:
        """The origin of a setting or an entry of it; one of a program is named by its key."""
        return self.said.get((key, entry)) or Origin(
            f"{key}.{entry}" if entry and key in _TABLES else key
        )

    def words(self, key: str, entry: str = "") -> str:
        """How messages name where a setting or an entry of it is said."""
        return self.of(key, entry).words

    def depth(self, key: str, entry: str = "") -> int:
        """How far down an entry is said: each file lies below the one that extends it."""
        file = self.of(key, entry).file
        return self.files.index(file) if file in self.files else -1


def entries(where: str, value: Any) -> Iterator[tuple[str, str]]:
    """The entries of a setting, each with how messages name where it is said."""
    yield "", where
    if isinstance(value, Mapping):
        for name, inner in value.items():
            joint = " " if where.startswith("--") else "."
            for entry, words in entries(f"{where}{joint}{name}", inner):
                yield f"{name}.{entry}" if entry else name, words
    elif isinstance(value, tuple):
        texts = (getattr(item, "pattern", item) for item in value)
        yield from ((text, where) for text in texts if isinstance(text, str))
