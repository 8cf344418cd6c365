"""Checks the settings that a program gives as those of a configuration file are checked."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

from usdvol_lint.config import Config, Glob
from usdvol_lint.config.combining import check_depth
from usdvol_lint.config.files import EXTEND
from usdvol_lint.config.origins import Origins
from usdvol_lint.config.per_path import PerPath
from usdvol_lint.config.values import CHECKS
from usdvol_lint.model import UsageError
from usdvol_lint.suppressions import Suppression
from usdvol_lint.words import quoted


def checked(config: Config) -> Config:
    """The same settings, each of the type that it is to have; raises UsageError for a wrong one.

    Patterns of stages may be texts, in relation to the working directory.
    """
    if not isinstance(config, Config) or not isinstance(config.origins, Origins):
        raise UsageError(f"the settings must be a usdvol_lint.Config, not {config!r}")
    given = {key: getattr(config, key.replace("-", "_")) for key in CHECKS if key != EXTEND}
    defaults = Config()._asdict()
    values = {
        name: _checked(key, name, value)
        for key, value in given.items()
        if value != defaults[name := key.replace("-", "_")]
        or type(value) is not type(defaults[name])
    }
    settings = config._replace(**values)
    check_depth(settings)
    return settings


def _checked(key: str, name: str, value: Any) -> Any:
    where = f"Config: {name}"
    match key:
        case "exclude" | "stages":
            return _globs(where, key, value)
        case "suppress" | "per-path":
            return _tables(where, key, value)
        case "frames" if isinstance(value, tuple | list):
            value = "-".join(map(str, value))
        case "search-path":
            for folder in CHECKS[key](where, _plain(where, value)):
                if not os.path.isdir(folder):
                    raise UsageError(f"{where}: there is no folder {quoted(folder)}")
    return CHECKS[key](where, _plain(where, value))


def _globs(where: str, key: str, value: Any) -> tuple[Glob, ...]:
    if not isinstance(value, tuple | list):
        CHECKS[key](where, value)  # which says what it must be
    globs = [each if isinstance(each, Glob) else Glob(os.curdir, each) for each in value]
    patterns = CHECKS[key](where, [each.pattern for each in globs])
    folders = [each.folder for each in globs]
    if not all(isinstance(folder, str) for folder in folders):
        raise UsageError(f"{where}: the folder of a pattern must be a text, not {folders!r}")
    return tuple(map(Glob, folders, patterns))


def _tables(where: str, key: str, value: Any) -> tuple[Any, ...]:
    """Tables as a file has them, or what is made of such, which keeps where it was said."""
    items = value if isinstance(value, tuple | list) else [value]
    written = [
        each.as_written() if isinstance(each, PerPath | Suppression) else each for each in items
    ]
    tables = CHECKS[key](where, _plain(where, written))
    return tuple(
        table._replace(where=str(getattr(each, "where", table.where)))
        for each, table in zip(items, tables, strict=True)
    )


def _plain(where: str, value: Any) -> Any:
    """A value as a file has it: lists and tables whose keys are texts."""
    if isinstance(value, Mapping):
        for key in value:
            if not isinstance(key, str):
                raise UsageError(f"{where} must be a table with texts as keys, not {key!r}")
        return {key: _plain(where, inner) for key, inner in value.items()}
    if isinstance(value, tuple | list):
        return [_plain(where, each) for each in value]
    return value
