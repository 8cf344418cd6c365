"""`assert_clean`, for the tests of programs that write stages."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path

from usdvol_lint.command.codes import CLEAN, exit_code
from usdvol_lint.config import FAIL_ON, Config
from usdvol_lint.config.files import read_config
from usdvol_lint.config.given import checked
from usdvol_lint.config.values import filled, one_of
from usdvol_lint.model import Severity, UsageError
from usdvol_lint.report import Options, render
from usdvol_lint.report.verdict import verdict
from usdvol_lint.results import Report
from usdvol_lint.run.lint import Naming, lint
from usdvol_lint.run.roots import root_of

_FAIL_ON = tuple(level for level in FAIL_ON if level != "never")


def assert_clean(
    *paths: str | os.PathLike[str],
    select: str | Iterable[str] | None = None,
    ignore: str | Iterable[str] = (),
    fail_on: str | None = None,
    config: Config | str | os.PathLike[str] | None = None,
) -> None:
    """Raises AssertionError, with the report as its text, unless the stages at `paths` are clean.

    Paths are stages, or folders that are searched for them; a stage that can't be read is not
    clean.  `select` and `ignore` are codes or prefixes of codes, `fail_on` is `error`, `warning`
    or `info`.  They stand above `config`, the settings or the configuration file that has them;
    where none is named, none is searched for.  A baseline is not heeded, nor is `never` for
    `fail-on` in `config`, which is `error` here.
    Raises UsageError for what is wrong with these arguments, and where nothing is checked.
    """
    __tracebackhide__ = True  # pytest then shows the line of the test
    named = [_path("a path", path) for path in paths]
    if not named:
        raise UsageError("assert_clean: nothing to check: name a stage or a folder")
    file = None if config is None or isinstance(config, Config) else Path(_path("config", config))
    base = checked(
        read_config(file) if file else config if isinstance(config, Config) else Config()
    )
    settings = base._replace(
        select=base.select if select is None else _codes("select", select),
        ignore=base.ignore + _codes("ignore", ignore),
        fail_on=_fail_on(base, fail_on),
    )
    if settings.select == ():
        raise UsageError("assert_clean: `select` is empty: with no rule on, nothing can be found")
    folder = str(file.parent) if file else None
    root = root_of(named, configured=settings.root, config_folder=folder)
    report = lint(named, settings, naming=lambda _: Naming(root))
    if not report.stages:
        raise UsageError(f"assert_clean: nothing was checked: {report.nothing}")
    if exit_code(report, settings) != CLEAN:
        raise AssertionError(_told(report, settings))


def _path(what: str, given: object) -> str:
    path = os.fspath(given) if isinstance(given, str | os.PathLike) else None
    if not isinstance(path, str):
        hint = "; name several one by one" if isinstance(given, Iterable) else ""
        raise UsageError(f"assert_clean: {what} must be a text or a Path, not {given!r}{hint}")
    return path


def _codes(name: str, given: str | Iterable[str]) -> tuple[str, ...]:
    """The codes, one by one; a text may have several, separated by commas."""
    lists = [given] if isinstance(given, str) else given
    if not isinstance(lists, Iterable) or isinstance(lists, bytes):
        raise UsageError(f"{name} must be a text or a list of texts, not {given!r}")
    texts = filled(name, [each.strip(", ") if type(each) is str else each for each in lists])
    return tuple(code.strip() for codes in texts for code in codes.split(",") if code.strip())


def _fail_on(base: Config, given: str | None) -> str:
    """The level that fails a test; a test that never fails would hold nothing."""
    if given is not None:
        return one_of("fail_on", given, _FAIL_ON)
    return base.fail_on if base.fail_on in _FAIL_ON else Config().fail_on


def _told(report: Report, settings: Config) -> str:
    """The verdict, which pytest's own summary repeats, and the findings."""
    options = Options(
        quiet=True,
        least=settings.least_shown,
        show=frozenset(settings.show),
        fail_on=Severity[settings.fail_on.upper()],
        fail_on_unchecked=settings.fail_on_unchecked,
    )
    return f"{verdict(report, options)}\n\n{render(report, 'full', options)}"
