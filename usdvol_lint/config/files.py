"""Finds configuration files, and reads settings from them."""

from __future__ import annotations

from os.path import isfile, join
from typing import TYPE_CHECKING, Any

from usdvol_lint.config import Config, Glob
from usdvol_lint.config.values import CHECKS, table
from usdvol_lint.model import UsageError
from usdvol_lint.nearest import did_you_mean

if TYPE_CHECKING:
    from pathlib import Path

FILE_NAME = "usdvol-lint.toml"
TABLE = "usdvol-lint"


def find_config_file(start: Path) -> Path | None:
    """The configuration file of a folder, or of the nearest one above it that has one.

    It is a usdvol-lint.toml, or else a pyproject.toml with a table [tool.usdvol-lint].
    """
    for folder in (start, *start.parents):
        own = folder / FILE_NAME
        if isfile(own):
            return own
        project = folder / "pyproject.toml"
        if isfile(project) and _own_table(project) is not None:
            return project
    return None


def read_config(path: Path) -> Config:
    """Reads a configuration file; paths in it are relative to the file.

    Raises UsageError where it can't be read, or says what is not allowed.
    """
    own = _own_table(path) if path.name == "pyproject.toml" else _read_toml(path)
    if own is None:
        raise UsageError(f"{path} has no table [tool.{TABLE}]")
    values = {}
    given = table(f"{path}: tool.{TABLE}", own)
    # A file that is written for another version may have keys that this one doesn't know.
    for key in sorted(given, key=lambda key: key != "required-version"):
        value = given[key]
        if key not in CHECKS:
            raise UsageError(f"{path}: unknown key {key!r}{did_you_mean(key, CHECKS)}")
        values[key.replace("-", "_")] = CHECKS[key](f"{path}: {key}", value)
    return Config(**{name: _anchored(name, value, path.parent) for name, value in values.items()})


def _anchored(name: str, value: Any, folder: Path) -> Any:
    """A setting whose paths are relative to the folder of the file, as it holds anywhere."""
    match name:
        case "root" | "baseline":
            return str(folder / value)
        case "packs" | "search_path":
            return tuple(str(folder / path) for path in value)
        case "exclude" | "stages":
            return tuple(Glob(str(folder), pattern) for pattern in value)
        case "path_map":
            return {start: join(folder, to) for start, to in value.items()}
        case _:
            return value


def _own_table(project: Path) -> Any | None:
    """The value of tool.usdvol-lint in a pyproject.toml; None if there is none."""
    tools = _read_toml(project).get("tool", {})
    return tools.get(TABLE) if isinstance(tools, dict) else None


def _read_toml(path: Path) -> dict[str, Any]:
    import tomllib  # costs start-up time, and worker processes read no configuration

    try:
        with path.open("rb") as file:
            return tomllib.load(file)
    except tomllib.TOMLDecodeError as error:
        raise UsageError(f"{path}: {error}") from error
    except UnicodeDecodeError as error:
        raise UsageError(f"{path}: not UTF-8 text") from error
    except OSError as error:
        raise UsageError(f"{path}: {error.strerror}") from error
