"""Lints stages as the options of the command line say, and writes what they ask for."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

import click

from usdvol_lint.command import output
from usdvol_lint.command.codes import CLEAN, exit_code
from usdvol_lint.command.progress import ProgressBar
from usdvol_lint.command.settings import read_settings
from usdvol_lint.model import UsageError
from usdvol_lint.run.causes import versions_in
from usdvol_lint.run.lint import Naming, lint
from usdvol_lint.run.roots import root_of

if TYPE_CHECKING:
    from pathlib import Path
    from subprocess import Popen

    from usdvol_lint.baseline.use import Prepared
    from usdvol_lint.command.output import Destination
    from usdvol_lint.config import Config
    from usdvol_lint.results import Report, RunInfo


def lint_stages(
    paths: tuple[str, ...], given: dict[str, Any], child: Popen[bytes] | None = None
) -> int:
    """Lints stages as the options say, writes what they ask for, and returns the exit code.

    `given` are the options by their names in Python; `child` is the first worker process.
    """
    settled: list[tuple[Config, Path | None, list[Destination], Prepared | None]] = []

    def settle() -> Config:
        config, file = read_settings(given)
        destinations = output.pair(given["output_format"], given["output"], config.output_format)
        output.check_writable(destinations)
        settled.append((config, file, destinations, _prepared(given, config)))
        return config

    def naming(config: Config) -> Naming:
        _, file, _, prepared = settled[0]
        of_baseline = prepared.root if prepared else None
        folder = str(file.parent) if file else None
        root = root_of(paths, given["root"], of_baseline, config.root, folder)
        if prepared:
            prepared.check_root(root)
        return Naming(root, versions_in(config.version_pattern))

    with ProgressBar(enabled=not given["quiet"] and sys.stderr.isatty()) as progress:
        report = lint(paths, settle, progress, child, naming)
    config, file, destinations, prepared = settled[0]
    report = report._replace(run=_run_info(report, file))
    report, failure = prepared.apply(report) if prepared else (report, "")
    output.write(report, destinations, output.options_of(given, config))
    if config.suppress and not given["quiet"]:
        _tell_expired(config)
    if failure:
        raise UsageError(failure)
    if given["write_baseline"] is not None:
        return CLEAN
    return exit_code(report, config.fail_on, given["fail_on_unpruned"])


def _prepared(given: dict[str, Any], config: Config) -> Prepared | None:
    """The baseline in use, read; runs without one import nothing for it."""
    asking = ("write_baseline", "prune_baseline", "fail_on_unpruned", "moved")
    if config.baseline is None and not any(given[name] for name in asking):
        return None
    from usdvol_lint.command.baselines import prepared

    return prepared(given, config)


def _tell_expired(config: Config) -> None:
    """Says on standard error why what a table of the configuration suppressed is back."""
    from usdvol_lint.run.suppressing import expired

    for line in expired(config):
        click.echo(f"usdvol-lint: {line}", err=True)


def _run_info(report: Report, file: Path | None) -> RunInfo:
    from datetime import UTC, datetime

    return report.run._replace(
        date=datetime.now(UTC).isoformat(timespec="seconds"),
        command=("usdvol-lint", *sys.argv[1:]),
        config_file=str(file) if file else None,
    )
