"""`assert_clean`, for the tests of programs that write stages."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path

from usdvol_lint.command.codes import CLEAN, exit_code
from usdvol_lint.config import FAIL_ON, Config
from usdvol_lint.config.files import read_config
from usdvol_lint.config.values import one_of
from usdvol_lint.model import Severity, UsageError
from usdvol_lint.report import Options, render
from usdvol_lint.report.verdict import verdict
from usdvol_lint.results import Report
from usdvol_lint.run.lint import Naming, lint
from usdvol_lint.run.roots import root_of


def assert_clean(
    *paths: str | os.PathLike[str],
    select: str | Iterable[str] = (),
    ignore: str | Iterable[str] = (),
    fail_on: str | None = None,
    config: Config | str | os.PathLike[str] | None = None,
) -> None:
    """Raises AssertionError, with the report as its text, unless the stages at `paths` are clean.

    Paths are stages, or folders that are searched for them; a stage that can't be read is not
    clean.  `select` and `ignore` are codes or prefixes of codes, `fail_on` is `error`, `warning`
    or `info`.  They stand above `config`, the settings or the configuration file that has them;
    where none is named, none is searched for.  A baseline is not heeded.
    Raises UsageError for what is wrong with these arguments.
    """
    __tracebackhide__ = True  # pytest then shows the line of the test
    named = [os.fspath(path) for path in paths]
    if not named:
        raise UsageError("assert_clean: nothing to check: name a stage or a folder")
    file = None if config is None or isinstance(config, Config) else Path(config)
    base = read_config(file) if file else config if isinstance(config, Config) else Config()
    settings = base._replace(
        select=_codes(select) or base.select,
        ignore=base.ignore + _codes(ignore),
        fail_on=base.fail_on if fail_on is None else one_of("fail_on", fail_on, FAIL_ON),
    )
    folder = str(file.parent) if file else None
    root = root_of(named, configured=settings.root, config_folder=folder)
    report = lint(named, settings, naming=lambda _: Naming(root))
    if exit_code(report, settings) != CLEAN:
        raise AssertionError(_told(report, settings))


def _codes(given: str | Iterable[str]) -> tuple[str, ...]:
    """The codes, one by one; a text may have several, separated by commas."""
    lists = [given] if isinstance(given, str) else given
    return tuple(code.strip() for codes in lists for code in codes.split(",") if code.strip())


def _told(report: Report, settings: Config) -> str:
    """The verdict, which pytest's own summary repeats, and the findings."""
    options = Options(
        quiet=True,
        least=settings.least_shown,
        show=frozenset(settings.show),
        fail_on=None if settings.fail_on == "never" else Severity[settings.fail_on.upper()],
        fail_on_unchecked=settings.fail_on_unchecked,
    )
    return f"{verdict(report, options)}\n\n{render(report, 'full', options)}"
