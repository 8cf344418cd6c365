"""The tables `[[per-path]]` of a configuration: what holds for some layers and not for others."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from usdvol_lint.config.values import filled, levels
from usdvol_lint.model import UsageError
from usdvol_lint.suppressions import check_known, patterns, tables_of

_KEYS = ("files", "severity", "ignore")


class PerPath(NamedTuple):
    """A table `[[per-path]]` of a configuration; `where` is how messages name it.

    `files` are patterns as in a .gitignore for the layer to blame; `severity` and `ignore` are what
    they are for all layers.
    """

    where: str
    files: tuple[str, ...]
    severity: Mapping[str, str] = {}
    ignore: tuple[str, ...] = ()

    def as_written(self) -> dict[str, object]:
        """What the table says, by its keys."""
        said = self._asdict()
        return {key: said[key] for key in _KEYS if said[key]}


def read_per_path(where: str, value: Any) -> tuple[PerPath, ...]:
    """The tables; raises UsageError, which `where` begins, for what is wrong with one."""
    return tuple(_read(*each) for each in tables_of(where, value, "per-path"))


def _read(where: str, table: dict[str, Any]) -> PerPath:
    check_known(where, table, _KEYS)
    if "files" not in table:
        raise UsageError(f"{where}: 'files' must say for which layers this is")
    if not table.get("severity") and not table.get("ignore"):
        raise UsageError(f"{where}: say what is so there, with severity or ignore")
    return PerPath(
        where,
        patterns(f"{where}: files", table["files"]),
        levels(f"{where}: severity", table.get("severity", {})),
        filled(f"{where}: ignore", table.get("ignore", [])),
    )
