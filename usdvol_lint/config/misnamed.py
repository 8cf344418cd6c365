"""Tells those who misname our file or our table, instead of leaving out what they say."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from os.path import isfile
from typing import TYPE_CHECKING, Any

from usdvol_lint.config.values import CHECKS
from usdvol_lint.model import UsageError
from usdvol_lint.nearest import is_one_slip_from

if TYPE_CHECKING:
    from pathlib import Path

FILE_NAME = "usdvol-lint.toml"
TABLE = "usdvol-lint"
_MISNAMED = ("usdvol_lint.toml", ".usdvol-lint.toml", ".usdvol_lint.toml", "usdvollint.toml")
_SHORT = "usdvol"


def check_names(folder: Path) -> None:
    """Raises UsageError for a file in a folder that would be read under another name."""
    for name in _MISNAMED:
        if isfile(folder / name):
            raise UsageError(f"{folder / name} is not read: call it {FILE_NAME}")


def check_tables(project: Path, data: Mapping[str, Any]) -> None:
    """Raises UsageError for a table of a pyproject.toml that would be read under another name."""
    for name in _misnamed(data):
        raise UsageError(f"{project}: the table [{name}] is not read: call it [tool.{TABLE}]")


def check_keys(file: Path, data: Mapping[str, Any]) -> None:
    """Raises UsageError where a file of ours has its keys in the table of a pyproject.toml."""
    for name in ("tool", TABLE):
        if name in data:
            table = f"tool.{TABLE}" if name == "tool" else name
            raise UsageError(f"{file}: the keys stand at the top of this file: leave out [{table}]")


def _misnamed(data: Mapping[str, Any]) -> Iterator[str]:
    yield from (name for name in data if _folded(name) == _folded(TABLE))
    for outer in ("tool", "tools"):
        tables = data.get(outer)
        for name, table in tables.items() if isinstance(tables, Mapping) else ():
            if name == TABLE and outer == "tool":
                continue
            if _folded(name) == _folded(TABLE) or (_is_near(name) and _has_our_keys(table)):
                yield f"{outer}.{name}"
            elif name == _SHORT and isinstance(table, Mapping) and _has_our_keys(table.get("lint")):
                yield f"{outer}.{name}.lint"


def _is_near(name: str) -> bool:
    return name.lower() == _SHORT or is_one_slip_from(name, TABLE)


def _has_our_keys(table: Any) -> bool:
    """Whether it is a table that holds settings of ours alone: another tool has others."""
    if not isinstance(table, Mapping) or not table:
        return False
    return all(key.replace("_", "-") in CHECKS for key in table)


def _folded(name: str) -> str:
    return "".join(letter for letter in name.lower() if letter.isalnum())
