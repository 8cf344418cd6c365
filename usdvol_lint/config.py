"""Configuration: pyproject.toml or usdvol-lint.toml, then the command line, become one Config."""

from __future__ import annotations

from collections.abc import Mapping
from os.path import isfile
from typing import TYPE_CHECKING, Any, NamedTuple

from usdvol_lint.model import Severity, UsageError
from usdvol_lint.nearest import did_you_mean

if TYPE_CHECKING:
    from pathlib import Path

FILE_NAME = "usdvol-lint.toml"
TABLE = "usdvol-lint"
FAIL_ON = ("error", "warning", "info", "never")
OUTPUT_FORMATS = ("full", "concise", "json")
LOADS = ("all", "none")
CONTENTS = ("all", "first", "off")
VARIANTS = ("selected", "all")
_CHOICES = {
    "fail-on": FAIL_ON,
    "output-format": OUTPUT_FORMATS,
    "load": LOADS,
    "content": CONTENTS,
    "variants": VARIANTS,
}
TIMES = ("all", "first", "ends")
LEVELS = tuple(severity.label for severity in reversed(Severity))
LONGEST_TIMEOUT = 1_000_000


class Config(NamedTuple):
    """What a run was asked for. `jobs` of 0 means one for each processor."""

    select: tuple[str, ...] = ()
    ignore: tuple[str, ...] = ()
    severity: Mapping[str, str] = {}
    options: Mapping[str, Mapping[str, Any]] = {}
    packs: tuple[str, ...] = ()
    fail_on: str = "error"
    output_format: str = "full"
    jobs: int = 0
    timeout: float = 300.0
    load: str = "all"
    content: str = "all"
    variants: str = "selected"
    variant_limit: int = 100
    times: str | int = "all"
    statistics: bool = False

    @property
    def depth(self) -> Depth:
        """How much of each stage is looked at."""
        selections = self.variant_limit if self.variants == "all" else 0
        return Depth(self.load, self.content, self.times, self.statistics, selections)


class Depth(NamedTuple):
    """How much of each stage is looked at.

    `load` says whether payloads are, `content` how many of a field's files (all, first or off),
    `times` which time samples of particles (all, first, ends, or so many), `selections` how many
    variant selections besides the authored ones at most; `statistics` asks for the numbers of
    particle fields too.
    """

    load: str = "all"
    content: str = "all"
    times: str | int = "all"
    statistics: bool = False
    selections: int = 0


def find_config_file(start: Path) -> Path | None:
    """The nearest configuration from a folder upward; pyproject.toml counts with our table."""
    for folder in (start, *start.parents):
        own = folder / FILE_NAME
        if isfile(own):
            return own
        project = folder / "pyproject.toml"
        if isfile(project) and _own_table(project) is not None:
            return project
    return None


def read_config(path: Path) -> Config:
    """Reads a configuration file; pack folders in it are relative to the file."""
    table = _own_table(path) if path.name == "pyproject.toml" else _read_toml(path)
    if table is None:
        raise UsageError(f"{path} has no table [tool.{TABLE}]")
    known = {name.replace("_", "-"): name for name in Config._fields}
    values = {}
    for key, value in _table(f"{path}: tool.{TABLE}", table).items():
        if key not in known:
            raise UsageError(f"{path}: unknown key {key!r}{did_you_mean(key, known)}")
        values[known[key]] = _checked(path, key, value)
    config = Config(**values)
    packs = tuple(str(path.parent / pack) for pack in config.packs)
    return config._replace(packs=packs)


def _own_table(project: Path) -> Any | None:
    """What a pyproject.toml says of us."""
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


def _checked(path: Path, key: str, value: Any) -> Any:
    where = f"{path}: {key}"
    if key in ("select", "ignore", "packs"):
        return tuple(strings(where, value))
    if key in _CHOICES:
        return one_of(where, value, _CHOICES[key])
    if key == "severity":
        return {
            k: one_of(f"{where}.{k}", level, LEVELS) for k, level in _table(where, value).items()
        }
    if key == "options":
        return {str(k): _table(f"{where}.{k}", v) for k, v in _table(where, value).items()}
    if key == "timeout":
        return timeout(where, value)
    if key == "times":
        return times(where, value)
    if key == "statistics":
        if not isinstance(value, bool):
            raise UsageError(f"{where} must be true or false, not {value!r}")
        return value
    least = 1 if key == "variant-limit" else 0
    if isinstance(value, bool) or not isinstance(value, int) or value < least:
        raise UsageError(f"{where} must be a whole number from {least}, not {value!r}")
    return value


def timeout(where: str, value: Any) -> float:
    """The value, if it is a time limit that a timer takes."""
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    if not is_number or not 0 < value <= LONGEST_TIMEOUT:
        wanted = f"a number of seconds above 0, at most {LONGEST_TIMEOUT:,}"
        raise UsageError(f"{where} must be {wanted}, not {value!r}")
    return float(value)


def times(where: str, value: Any) -> str | int:
    """The value, if it says which time samples of particles are looked at."""
    if isinstance(value, str) and value.isascii() and value.isdigit():
        value = int(value)
    is_number = isinstance(value, int) and not isinstance(value, bool) and value > 0
    if value not in TIMES and not is_number:
        wanted = f"{', '.join(TIMES)} or a whole number from 1"
        raise UsageError(f"{where} must be {wanted}, not {value!r}")
    return value  # type: ignore[no-any-return]


def strings(where: str, value: Any) -> list[str]:
    """The value, if it is a list of strings."""
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
