"""The settings of a run: those of the configuration file, with the command line on top of them."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import click

from usdvol_lint.config import Config, Glob
from usdvol_lint.config.files import find_config_file, read_config
from usdvol_lint.config.values import CHECKS, globs, level, shown
from usdvol_lint.model import UsageError

_REPLACING = (
    *("jobs", "timeout", "fail-on", "load", "content", "variants", "times", "statistics"),
    *("max-places", "root", "baseline", "today", "frames"),
)
"""The options that replace what the file says; the others add to it."""


def read_settings(given: dict[str, Any]) -> tuple[Config, Path | None]:
    """The settings, and the configuration file if there is one.

    `given` are the options of the command line by their names in Python: those not given are None,
    False or empty.
    Raises UsageError and click.UsageError for what the user has to change.
    """
    file = _config_file(given["config_file"], given["isolated"])
    base = read_config(file) if file else Config()
    changes: dict[str, Any] = {
        "packs": base.packs + given["pack"],
        "show": base.show + shown("--show", list(given["show"])),
        "exclude": base.exclude + _excluded(given["exclude"]),
        "search_path": base.search_path + _folders("--search-path", given["search_path"]),
    }
    for key in _REPLACING:
        name = key.replace("-", "_")
        value = given[name]
        if value is not None and value is not False:
            changes[name] = CHECKS[key](f"--{key}", value)
    if given["no_baseline"]:
        if given["baseline"] is not None:
            raise click.UsageError("--baseline and --no-baseline exclude each other")
        changes["baseline"] = None
    if given["no_suppressions"]:
        changes["suppressions"] = "none"
    for name in given["output_format"]:
        CHECKS["output-format"]("--output-format", name)
    select = _codes(given["select"])
    if select:
        changes["select"] = select
    changes["ignore"] = _still_ignored(base.ignore, select) + _codes(given["ignore"])
    changes["severity"] = {**base.severity, **_severities(given["severity"])}
    settings = base._replace(**changes)
    _check_depth(settings)
    return settings, file


def _check_depth(settings: Config) -> None:
    """Raises UsageError where a suppression would seem unused because little is looked at."""
    if "unused" not in settings.show:
        return
    for name in ("load", "content", "times"):
        value = getattr(settings, name)
        if value != "all":
            raise UsageError(
                f"--show unused needs a run that looks at everything: leave out --{name} {value}"
            )


def _config_file(named: str | None, isolated: bool) -> Path | None:
    try:
        here = Path.cwd()
    except OSError:
        raise UsageError("the working directory is not there any more") from None
    if named and isolated:
        raise click.UsageError("--config and --isolated exclude each other")
    if named:
        return Path(named)
    return None if isolated else find_config_file(here)


def _still_ignored(ignored: tuple[str, ...], select: tuple[str, ...]) -> tuple[str, ...]:
    """What the file ignores, without the codes that the command line selects by name."""
    selected = {code.upper() for code in select}
    return tuple(code for code in ignored if code.strip().upper() not in selected)


def _excluded(patterns: tuple[str, ...]) -> tuple[Glob, ...]:
    return tuple(Glob(os.curdir, each) for each in globs("--exclude", list(patterns)))


def _folders(option: str, named: tuple[str, ...]) -> tuple[str, ...]:
    for folder in named:
        if not os.path.isdir(folder):
            raise UsageError(f"{option} {folder}: no such folder")
    return named


def _codes(lists: tuple[str, ...]) -> tuple[str, ...]:
    """The codes in lists that are separated by commas."""
    return tuple(code.strip() for codes in lists for code in codes.split(",") if code.strip())


def _severities(pairs: tuple[str, ...]) -> dict[str, str]:
    """Severities by code, from `CODE=LEVEL`."""
    severities = {}
    for pair in _codes(pairs):
        code, equals, name = (part.strip() for part in pair.partition("="))
        if not equals:
            raise UsageError(f"--severity {pair}: write it as CODE=LEVEL, such as AST002=warning")
        severities[code] = level(f"--severity {code}", name)
    return severities
