"""Lays settings over others: those of a file over what it extends, the command line over all."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from usdvol_lint.config import Config
from usdvol_lint.config.origins import Origin, entries

_OWN_FIRST = frozenset({"suppress", "search-path"})
"""Lists of which the first that matches counts."""
_REPLACED = frozenset({"select", "frames"})
"""What is replaced as a whole, though it has several parts."""


def laid_over(
    base: Config, values: Mapping[str, Any], where: Callable[[str], str], file: str | None = None
) -> Config:
    """The settings with other values, by key, on top of them.

    Lists are added to, but for `select`, tables are merged key by key, all else is replaced.
    `where` says how messages name where a key has its value, which is in `file`, if in one.
    """
    said = dict(base.origins.said)
    merged: dict[str, Any] = {}
    for key, value in values.items():
        name = key.replace("-", "_")
        merged[name] = _merged(key, getattr(base, name), value)
        for entry, words in entries(where(key), value):
            said[key, entry] = Origin(words, file)
    return base._replace(**merged, origins=base.origins._replace(said=said))


def _merged(key: str, below: Any, value: Any) -> Any:
    if isinstance(value, Mapping) and isinstance(below, Mapping):
        return _merged_tables(below, value)
    if isinstance(value, tuple) and key not in _REPLACED:
        return value + below if key in _OWN_FIRST else below + value
    return value


def _merged_tables(below: Mapping[str, Any], own: Mapping[str, Any]) -> dict[str, Any]:
    """Own keys come last: of several for one rule, by code and by name, the last wins."""
    kept = {key: value for key, value in below.items() if key not in own}
    return {**kept, **{key: _merged("", below.get(key), value) for key, value in own.items()}}
