"""Configuration: pyproject.toml or usdvol-lint.toml, then the command line, become one Config."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from pathlib import Path
from typing import Any

from usdvol_lint.catalog import Catalog, did_you_mean
from usdvol_lint.model import Severity, UsageError

FILE_NAME = "usdvol-lint.toml"
TABLE = "usdvol-lint"
FAIL_ON = ("error", "warning", "info", "never")
OUTPUT_FORMATS = ("full", "concise", "json")
LOADS = ("all", "none")
LEVELS = tuple(severity.label for severity in reversed(Severity))


@dataclass(frozen=True, slots=True)
class Config:
    """What a run was asked for. `jobs` of 0 means one for each processor."""

    select: tuple[str, ...] = ()
    ignore: tuple[str, ...] = ()
    severity: Mapping[str, str] = field(default_factory=dict)
    options: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    packs: tuple[str, ...] = ()
    fail_on: str = "error"
    output_format: str = "full"
    jobs: int = 0
    timeout: float = 300.0
    load: str = "all"


@dataclass(frozen=True, slots=True)
class ActiveRules:
    """What of the catalog is switched on: severity and options by code."""

    severities: Mapping[str, Severity]
    options: Mapping[str, Mapping[str, Any]]


def find_config_file(start: Path) -> Path | None:
    """The nearest configuration from a folder upward; a pyproject.toml counts if it has our table."""
    for folder in (start, *start.parents):
        own = folder / FILE_NAME
        if own.is_file():
            return own
        project = folder / "pyproject.toml"
        if project.is_file() and TABLE in _read_toml(project).get("tool", {}):
            return project
    return None


def read_config(path: Path) -> Config:
    """Reads a configuration file; pack folders in it are relative to the file."""
    table = _read_toml(path)
    if path.name == "pyproject.toml":
        table = table.get("tool", {}).get(TABLE, {})
    known = {f.name.replace("_", "-"): f.name for f in fields(Config)}
    values = {}
    for key, value in table.items():
        if key not in known:
            raise UsageError(f"{path}: unknown key {key!r}{did_you_mean(key, known)}")
        values[known[key]] = _checked(path, key, value)
    config = Config(**values)
    packs = tuple(str(path.parent / pack) for pack in config.packs)
    return replace(config, packs=packs)


def activate(config: Config, catalog: Catalog) -> ActiveRules:
    """Resolves selection, severities and options against the catalog; unknown ones are errors."""
    codes = catalog.select(config.select, config.ignore)
    severities = {code: catalog.rules[code].severity for code in sorted(codes)}
    for selector, level in config.severity.items():
        for code in catalog.expand(selector) & severities.keys():
            severities[code] = Severity[level.upper()]
    options = {}
    for name, given in config.options.items():
        rule = catalog.find(name)
        options[rule.code] = dict(given)
        for option, value in given.items():
            _check_option(rule.name, rule.options, option, value)
    return ActiveRules(severities, options)


def _check_option(name: str, known: Mapping[str, Any], option: str, value: Any) -> None:
    if option not in known:
        raise UsageError(f"{name} has no option {option!r}{did_you_mean(option, known)}")
    default = known[option]
    kind = (int, float) if isinstance(default, float) else type(default)
    if not isinstance(value, kind) or isinstance(value, bool) != isinstance(default, bool):
        wanted = type(default).__name__
        raise UsageError(f"{name}: option {option!r} must be a {wanted}, not {value!r}")


def _read_toml(path: Path) -> dict[str, Any]:
    try:
        with path.open("rb") as file:
            return tomllib.load(file)
    except tomllib.TOMLDecodeError as error:
        raise UsageError(f"{path}: {error}") from error
    except UnicodeDecodeError as error:
        raise UsageError(f"{path}: not UTF-8 text") from error
    except OSError as error:
        raise UsageError(f"{path}: {error.strerror}") from error


def _checked(path: Path, key: str, value: Any) -> Any:
    where = f"{path}: {key}"
    if key in ("select", "ignore", "packs"):
        return tuple(_strings(where, value))
    if key in ("fail-on", "output-format", "load"):
        return one_of(where, value, {"fail-on": FAIL_ON, "load": LOADS}.get(key, OUTPUT_FORMATS))
    if key == "severity":
        return {str(k): one_of(f"{where}.{k}", v, LEVELS) for k, v in _table(where, value).items()}
    if key == "options":
        return {str(k): _table(f"{where}.{k}", v) for k, v in _table(where, value).items()}
    if isinstance(value, bool) or not isinstance(value, int if key == "jobs" else (int, float)):
        raise UsageError(f"{where} must be a number, not {value!r}")
    if value < 0 or (key == "timeout" and value == 0):
        raise UsageError(f"{where} must be positive, not {value!r}")
    return value


def _strings(where: str, value: Any) -> list[str]:
    if not isinstance(value, list) or not all(isinstance(item, str) for item in value):
        raise UsageError(f"{where} must be a list of strings, not {value!r}")
    return value


def _table(where: str, value: Any) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise UsageError(f"{where} must be a table, not {value!r}")
    return value


def one_of(where: str, value: Any, allowed: tuple[str, ...]) -> str:
    """The value, if it is allowed."""
    if value in allowed:
        return str(value)
    hint = did_you_mean(value, allowed) if isinstance(value, str) else ""
    raise UsageError(f"{where} must be one of {', '.join(allowed)}, not {value!r}{hint}")
