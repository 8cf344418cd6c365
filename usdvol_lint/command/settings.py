"""The settings of a run: those of the configuration file, with the command line on top of them."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import click

from usdvol_lint.config import SUMMARIES, Config, Glob
from usdvol_lint.config.combining import check_depth
from usdvol_lint.config.files import find_config_file, read_config
from usdvol_lint.config.layers import laid_over
from usdvol_lint.config.values import CHECKS, globs, level, one_of, shown
from usdvol_lint.model import UsageError
from usdvol_lint.paths import display
from usdvol_lint.words import quoted

_REPLACING = (
    *("jobs", "timeout", "memory-limit", "fail-on"),
    *("load", "content", "variants", "times", "statistics"),
    *("max-places", "root", "baseline", "today", "fail-on-unchecked", "frames"),
)
"""The options that replace what the file says."""


def read_settings(given: dict[str, Any]) -> tuple[Config, Path | None]:
    """The settings, and the configuration file if there is one.

    `given` are the options of the command line by their names in Python: those not given are None,
    False or empty.
    Raises UsageError and click.UsageError for what the user has to change.
    """
    check_filled(given)
    file = _config_file(given["config_file"], given["isolated"])
    base = read_config(file) if file else Config()
    if file and given["config_file"] is None:
        _check_found(base, file)
    settings = laid_over(base, dict(_values(given)), _option)
    check_depth(settings)
    return settings, file


def _check_found(config: Config, file: Path) -> None:
    """Raises UsageError where a configuration that nobody named has code of some folder run."""
    for pack in config.packs:
        where, folder = config.origins.words("packs", pack), display(pack)
        raise UsageError(
            f"{where}: {quoted(folder)} is no installed pack, and a configuration that was found "
            "loads no folder of rules, which are code: name it yourself with --pack "
            f"{folder}, or the configuration with --config {display(str(file))}"
        )


def _values(given: dict[str, Any]) -> Iterator[tuple[str, Any]]:
    """The settings that the command line says, by key."""
    for key in _REPLACING:
        value = given[key.replace("-", "_")]
        if value is not None and value is not False:
            yield key, CHECKS[key](f"--{key}", value)
    if given["no_baseline"]:
        if given["baseline"] is not None:
            raise click.UsageError("--baseline and --no-baseline exclude each other")
        yield "baseline", None
    if given["summary"] is not None:
        one_of("--summary", given["summary"], SUMMARIES)
    for name in given["output_format"]:
        CHECKS["output-format"]("--output-format", name)
    if len(given["output_format"]) == 1 and not given["output"]:
        yield "output-format", given["output_format"][0]
    if given["no_suppressions"]:
        yield "suppressions", "none"
    yield from ((key, read(given[name])) for key, name, read in _ADDING if given[name])


def _shown(given: tuple[str, ...]) -> tuple[str, ...]:
    return shown("--show", list(given))


def _option(key: str) -> str:
    """The option that says something of a key, and has not always its name."""
    return {"packs": "--pack", "suppressions": "--no-suppressions"}.get(key, f"--{key}")


def _config_file(named: str | None, isolated: bool) -> Path | None:
    try:
        here = Path.cwd()
    except OSError:
        raise UsageError("the working directory is not there any more") from None
    if named is not None and isolated:
        raise click.UsageError("--config and --isolated exclude each other")
    if named is not None:
        return Path(named)
    return None if isolated else find_config_file(here)


def _excluded(patterns: tuple[str, ...]) -> tuple[Glob, ...]:
    return tuple(Glob(os.curdir, each) for each in globs("--exclude", list(patterns)))


def _folders(option: str, named: tuple[str, ...]) -> tuple[str, ...]:
    for folder in named:
        if not os.path.isdir(folder):
            raise UsageError(f"{option} {folder}: no such folder")
    return named


def _codes(option: str, given: tuple[str, ...]) -> tuple[str, ...]:
    """The selectors in lists that are separated by commas; raises UsageError for an empty list."""
    return tuple(code for codes in given for code in _parts(f"--{option}", codes))


def _parts(option: str, given: str) -> list[str]:
    parts = [part.strip() for part in given.split(",")]
    _check_value(option, "".join(parts))
    return list(filter(None, parts))


def check_filled(given: dict[str, Any]) -> None:
    """Raises UsageError for an option with an empty value, which would ask for something else."""
    for name, value in given.items():
        option = "--config" if name == "config_file" else f"--{name.replace('_', '-')}"
        for each in value if isinstance(value, tuple) else (value,):
            if isinstance(each, str):
                _check_value(option, each)


def _check_value(option: str, value: str) -> None:
    """Raises UsageError for a value that is empty, as that of a variable of a script may be."""
    if not value.strip():
        raise UsageError(
            f"{option} has an empty value: if a script brings it, its variable is not set; "
            "leave the option out to say nothing"
        )


def _severities(given: tuple[str, ...]) -> dict[str, str]:
    """Severities by code, from `CODE=LEVEL`."""
    severities = {}
    for pair in _codes("severity", given):
        code, equals, name = (part.strip() for part in pair.partition("="))
        if not equals:
            raise UsageError(f"--severity {pair}: write it as CODE=LEVEL, such as AST002=warning")
        severities[code] = level(f"--severity {code}", name)
    return severities


_ADDING: tuple[tuple[str, str, Callable[[tuple[str, ...]], Any]], ...] = (
    ("packs", "pack", tuple),
    ("show", "show", _shown),
    ("exclude", "exclude", _excluded),
    ("search-path", "search_path", partial(_folders, "--search-path")),
    ("select", "select", partial(_codes, "select")),
    ("ignore", "ignore", partial(_codes, "ignore")),
    ("severity", "severity", _severities),
)
"""The keys that options which may be repeated add to, but for `select`: option, and its reader."""
