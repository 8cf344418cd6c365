"""The settings of a run, and how they are read from usdvol-lint.toml or pyproject.toml."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from os.path import isfile
from typing import TYPE_CHECKING, Any, NamedTuple

from usdvol_lint.model import Severity, UsageError
from usdvol_lint.nearest import did_you_mean
from usdvol_lint.releases import release, required_version

if TYPE_CHECKING:
    from pathlib import Path

    from usdvol_lint.suppressions import Suppression

FILE_NAME = "usdvol-lint.toml"
TABLE = "usdvol-lint"
FAIL_ON = ("error", "warning", "info", "never")
OUTPUT_FORMATS = ("full", "concise", "json")
SHOWABLE = ("info", "known", "suppressed", "unused")
SUPPRESSIONS = ("all", "configuration", "none")
LOADS = ("all", "none")
CONTENTS = ("all", "first", "off")
VARIANTS = ("selected", "all")
TIMES = ("all", "first", "ends")
LEVELS = tuple(severity.label for severity in reversed(Severity))
LONGEST_TIMEOUT = 1_000_000


class Config(NamedTuple):
    """The settings of a run.

    `jobs` is the number of worker processes, 0 for one for each processor; `timeout` is in seconds
    for each stage; `packs` are folders; `options` are those of rules, by code or name of the rule.
    `show` is what reports for people have besides errors and warnings.
    `max_places` is how many places of a cause a report has in full; `root` is the folder that
    layers go by in fingerprints, `version_pattern` what stands for any version in their paths.
    `baseline` is the file that has what is known.
    `required_version` says which versions of the tool the rest is written for; built-in rules that
    came after the release `rules_as_of` report infos.
    `suppressions` are those that are heeded: those in stages are not the `configuration`'s own,
    `suppress`; `today` is a date in place of the real one, for those that expire.
    See `Depth` for `load`, `content`, `times` and `statistics`.
    """

    select: tuple[str, ...] = ()
    ignore: tuple[str, ...] = ()
    # One empty dictionary for all: a Mapping is not written to, and a MappingProxyType can't be
    # pickled or copied.
    severity: Mapping[str, str] = {}
    options: Mapping[str, Mapping[str, Any]] = {}
    packs: tuple[str, ...] = ()
    fail_on: str = "error"
    output_format: str = "full"
    show: tuple[str, ...] = ()
    jobs: int = 0
    timeout: float = 300.0
    load: str = "all"
    content: str = "all"
    variants: str = "selected"
    variant_limit: int = 100
    times: str | int = "all"
    statistics: bool = False
    max_places: int = 20
    root: str | None = None
    version_pattern: str | None = None
    baseline: str | None = None
    required_version: str | None = None
    rules_as_of: str | None = None
    suppressions: str = "all"
    suppress: tuple[Suppression, ...] = ()
    today: str | None = None

    @property
    def least_shown(self) -> Severity:
        """The severity from which on reports for people have a finding."""
        return Severity.INFO if "info" in (*self.show, self.fail_on) else Severity.WARNING

    @property
    def depth(self) -> Depth:
        """How much of each stage is checked."""
        selections = self.variant_limit if self.variants == "all" else 0
        return Depth(self.load, self.content, self.times, self.statistics, selections)


class Depth(NamedTuple):
    """How much of each stage is checked.

    `load`: whether payloads are loaded (all, none).
    `content`: how many of a field's files are opened (all, first, off).
    `times`: which time samples of particles are read (all, first, ends, or their number).
    `statistics`: whether the figures of particle fields are collected.
    `selections`: how many variant selections at most, besides the authored ones.
    """

    load: str = "all"
    content: str = "all"
    times: str | int = "all"
    statistics: bool = False
    selections: int = 0


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
    table = _own_table(path) if path.name == "pyproject.toml" else _read_toml(path)
    if table is None:
        raise UsageError(f"{path} has no table [tool.{TABLE}]")
    values = {}
    given = _table(f"{path}: tool.{TABLE}", table)
    # A file that is written for another version may have keys that this one doesn't know.
    for key in sorted(given, key=lambda key: key != "required-version"):
        value = given[key]
        if key not in CHECKS:
            raise UsageError(f"{path}: unknown key {key!r}{did_you_mean(key, CHECKS)}")
        values[key.replace("-", "_")] = CHECKS[key](f"{path}: {key}", value)
    config = Config(**values)
    packs = tuple(str(path.parent / pack) for pack in config.packs)
    root = None if config.root is None else str(path.parent / config.root)
    baseline = None if config.baseline is None else str(path.parent / config.baseline)
    return config._replace(packs=packs, root=root, baseline=baseline)


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


def strings(where: str, value: Any) -> list[str]:
    """The value, if it is a list of strings."""
    if not isinstance(value, list) or not all(isinstance(item, str) for item in value):
        raise UsageError(f"{where} must be a list of strings, not {value!r}")
    return value


def one_of(where: str, value: Any, allowed: tuple[str, ...]) -> str:
    """The value, if it is one of those allowed."""
    if value in allowed:
        return str(value)
    hint = did_you_mean(value, allowed) if isinstance(value, str) else ""
    raise UsageError(f"{where} must be one of {', '.join(allowed)}, not {value!r}{hint}")


def level(where: str, value: Any) -> str:
    """The value, if it is the name of a severity."""
    return one_of(where, value, LEVELS)


def _strings(where: str, value: Any) -> tuple[str, ...]:
    return tuple(strings(where, value))


def shown(where: str, value: Any) -> tuple[str, ...]:
    """The value, if it is a list of what reports for people can show."""
    return tuple(one_of(where, word, SHOWABLE) for word in strings(where, value))


def _table(where: str, value: Any) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise UsageError(f"{where} must be a table, not {value!r}")
    return value


def _levels(where: str, value: Any) -> dict[str, str]:
    return {code: level(f"{where}.{code}", name) for code, name in _table(where, value).items()}


def _tables(where: str, value: Any) -> dict[str, dict[str, Any]]:
    return {
        rule: _table(f"{where}.{rule}", options) for rule, options in _table(where, value).items()
    }


def _boolean(where: str, value: Any) -> bool:
    if not isinstance(value, bool):
        raise UsageError(f"{where} must be true or false, not {value!r}")
    return value


def _text(where: str, value: Any) -> str:
    if not isinstance(value, str) or not value:
        raise UsageError(f"{where} must be a text, not {value!r}")
    return value


def _pattern(where: str, value: Any) -> str:
    """The value, if it is a regular expression."""
    import re  # few configurations have one

    try:
        re.compile(_text(where, value))
    except re.error as error:
        raise UsageError(f"{where}: {value!r} is no regular expression: {error}") from error
    return str(value)


def _suppress(where: str, value: Any) -> tuple[Suppression, ...]:
    from usdvol_lint.suppressions import read_tables  # few configurations have one

    return read_tables(where, value)


def _day(where: str, value: Any) -> str:
    from usdvol_lint.suppressions import date_of

    return date_of(where, value)


def _whole_number(where: str, value: Any, least: int) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or value < least:
        raise UsageError(f"{where} must be a whole number from {least}, not {value!r}")
    return value


def _timeout(where: str, value: Any) -> float:
    """The value, if it is a time limit, in seconds, that a timer takes."""
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    if not is_number or not 0 < value <= LONGEST_TIMEOUT:
        wanted = f"a number of seconds above 0, at most {LONGEST_TIMEOUT:,}"
        raise UsageError(f"{where} must be {wanted}, not {value!r}")
    return float(value)


def _times(where: str, value: Any) -> str | int:
    """The value, if it says which time samples of particles are read."""
    if isinstance(value, str) and value.isascii() and value.isdigit():
        value = int(value)
    is_number = isinstance(value, int) and not isinstance(value, bool) and value > 0
    if value not in TIMES and not is_number:
        wanted = f"{', '.join(TIMES)} or a whole number from 1"
        raise UsageError(f"{where} must be {wanted}, not {value!r}")
    return value  # type: ignore[no-any-return]


CHECKS: Mapping[str, Callable[[str, Any], Any]] = {
    "select": _strings,
    "ignore": _strings,
    "severity": _levels,
    "options": _tables,
    "packs": _strings,
    "fail-on": partial(one_of, allowed=FAIL_ON),
    "output-format": partial(one_of, allowed=OUTPUT_FORMATS),
    "show": shown,
    "jobs": partial(_whole_number, least=0),
    "timeout": _timeout,
    "load": partial(one_of, allowed=LOADS),
    "content": partial(one_of, allowed=CONTENTS),
    "variants": partial(one_of, allowed=VARIANTS),
    "variant-limit": partial(_whole_number, least=1),
    "times": _times,
    "statistics": _boolean,
    "max-places": partial(_whole_number, least=1),
    "root": _text,
    "version-pattern": _pattern,
    "baseline": _text,
    "required-version": required_version,
    "rules-as-of": release,
    "suppressions": partial(one_of, allowed=SUPPRESSIONS),
    "suppress": _suppress,
    "today": _day,
}
"""For each key of the configuration a function that returns the value for the `Config`.

It is called with where the value was given, which begins its UsageError, and the value.
"""
