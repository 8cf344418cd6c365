"""Writes settings as a configuration file that says just them."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator, Mapping
from itertools import groupby
from typing import Any

from usdvol_lint.config import Config
from usdvol_lint.config.files import EXTEND, PATHS
from usdvol_lint.config.values import CHECKS
from usdvol_lint.model import UsageError
from usdvol_lint.words import format_time, printable

_BARE = re.compile(r"[A-Za-z0-9_-]+")
_GLOBS = frozenset({"exclude", "stages"})
_LONE = range(0xD800, 0xE000)


def as_toml(config: Config) -> Iterator[str]:
    """The lines of a usdvol-lint.toml with these settings, wherever it lies.

    Each setting names where it is said, in a comment, and patterns of stages their folder: that is
    where a file with them has to lie.
    """
    values = {key: _value(config, key) for key in CHECKS if key != EXTEND}
    of_tables = {key for key, value in values.items() if value and _is_of_tables(value)}
    for key, value in values.items():
        if key not in of_tables:
            yield from _folders(config, key)
            yield from _setting(config, key, value)
    for key in filter(of_tables.__contains__, values):
        if isinstance(values[key], Mapping):
            yield from _table(config, key, values[key])
        else:
            yield from _tables(key, values[key])


def _value(config: Config, key: str) -> Any:
    """The value of a setting as a file says it, with absolute paths, which mean the same in each.

    A pattern stays as it is, for none can be written that is absolute.
    """
    value = getattr(config, key.replace("-", "_"))
    match key:
        case _ if key in _GLOBS:
            return tuple(glob.pattern for glob in value)
        case "frames":
            return value and "-".join(map(format_time, value))
        case "path-map":
            return {start: os.path.join(os.getcwd(), to) for start, to in value.items()}
        case _ if key in PATHS and value is not None:
            is_list = isinstance(value, tuple)
            return tuple(map(os.path.abspath, value)) if is_list else os.path.abspath(value)
        case _:
            return value


def _is_of_tables(value: Any) -> bool:
    return isinstance(value, Mapping) or (
        isinstance(value, tuple) and not all(isinstance(item, str) for item in value)
    )


def _setting(config: Config, key: str, value: Any) -> Iterator[str]:
    if value is None:
        yield f"# {key} is not set"
    elif value or not isinstance(value, Mapping):
        entries = [item for item in value if isinstance(item, str)] if type(value) is tuple else []
        yield f"{key} = {_toml(key, value)}{_comment(config, key, entries or [''])}"


def _folders(config: Config, key: str) -> Iterator[str]:
    """Which folder each pattern of stages is relative to."""
    globs = getattr(config, key) if key in _GLOBS else ()
    for folder, group in groupby(globs, lambda glob: os.path.abspath(glob.folder)):
        patterns = ", ".join(_toml(key, glob.pattern) for glob in group)
        yield f"# {patterns} of {key}: relative to {printable(folder)}"


def _table(config: Config, key: str, table: Mapping[str, Any]) -> Iterator[str]:
    """A table of settings; tables in it come after what else it has."""
    inner = {name: value for name, value in table.items() if isinstance(value, Mapping)}
    plain = {name: value for name, value in table.items() if name not in inner}
    if plain:
        yield from ("", f"[{key}]")
    for name, value in plain.items():
        yield f"{_key(key, name)} = {_toml(key, value)}{_comment(config, key, [name])}"
    for name, options in inner.items():
        yield from ("", f"[{key}.{_key(key, name)}]")
        for option, value in options.items():
            comment = _comment(config, key, [f"{name}.{option}"])
            yield f"{_key(key, option)} = {_toml(key, value)}{comment}"


def _tables(key: str, tables: Iterable[Any]) -> Iterator[str]:
    """Tables that stand below a line [[key]] each."""
    for each in tables:
        yield from ("", f"[[{key}]]  # {printable(each.where)}")
        yield from (f"{name} = {_toml(key, value)}" for name, value in each.as_written().items())


def _comment(config: Config, key: str, entries: Iterable[str]) -> str:
    """Where these entries of a setting are said."""
    said = (config.origins.said.get((key, entry)) for entry in entries)
    places = dict.fromkeys(origin.file or origin.words for origin in said if origin)
    return f"  # {printable(', '.join(places))}" if places else ""


def _key(setting: str, name: str) -> str:
    return name if _BARE.fullmatch(name) else _toml(setting, name)


def _toml(setting: str, value: Any) -> str:
    """A value as TOML has it; a setting may hold texts, numbers, truth, and lists and tables."""
    match value:
        case bool():
            return str(value).lower()
        case int() | float():
            return repr(value)
        case str():
            text = "".join(_letter(setting, letter) for letter in value)
            text = text.replace("##", r"#\u0023")  # which `printable` says why
            return f'"{text}"'
        case Mapping():
            pairs = (f"{_key(setting, name)} = {_toml(setting, value[name])}" for name in value)
            return f"{{ {', '.join(pairs)} }}" if value else "{}"
        case _:
            return f"[{', '.join(_toml(setting, item) for item in value)}]"


def _letter(setting: str, letter: str) -> str:
    """A letter of a text; what does not print is escaped, so that a terminal shows it."""
    if letter in '"\\':
        return f"\\{letter}"
    if letter.isprintable():
        return letter
    if ord(letter) in _LONE:
        raise UsageError(f"{setting} holds bytes that are no text, which no TOML file can have")
    return f"\\u{ord(letter):04x}" if ord(letter) <= 0xFFFF else f"\\U{ord(letter):08x}"
