"""Lints stages as the options of the command line say, and writes what they ask for."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import click

from usdvol_lint import __version__
from usdvol_lint.command import output
from usdvol_lint.command.arguments import outputs
from usdvol_lint.command.choosing import arguments, changes
from usdvol_lint.command.codes import CLEAN, ended_by, exit_code, signal_of
from usdvol_lint.command.progress import ProgressBar
from usdvol_lint.command.settings import read_settings
from usdvol_lint.config import Config
from usdvol_lint.model import UsageError
from usdvol_lint.packs.catalog import load_for
from usdvol_lint.report import FOR_HOSTS
from usdvol_lint.results import Report, RunInfo
from usdvol_lint.run.causes import versions_in
from usdvol_lint.run.interruption import Interruption
from usdvol_lint.run.lint import Naming, lint
from usdvol_lint.run.processors import owned
from usdvol_lint.run.roots import checkout_of, root_of
from usdvol_lint.words import printable, quoted

if TYPE_CHECKING:
    from pathlib import Path
    from subprocess import Popen

    from usdvol_lint.baseline.use import Prepared
    from usdvol_lint.command.output import Destination
    from usdvol_lint.files import Changes
    from usdvol_lint.report import Options


_IS_REPORTED = "what is wrong is in the reports"
_OTHER = frozenset({"--explain", "--list-rules", "--show-settings", "--show-files", "--test"})


def lint_stages(
    paths: tuple[str, ...], given: dict[str, Any], child: Popen[bytes] | None = None
) -> int:
    """Lints stages as the options say, writes what they ask for, and returns the exit code.

    `given` are the options by their names in Python; `child` is the first worker process.
    """
    try:
        return _linted(paths, given, child)
    except Exception as error:
        error.add_note(_IS_REPORTED)
        raise


def _linted(paths: tuple[str, ...], given: dict[str, Any], child: Popen[bytes] | None) -> int:
    job = _Job(paths, given)
    try:
        paths = job.read_list()
        shows = not given["quiet"] and sys.stderr.isatty()
        with Interruption() as signals, ProgressBar(enabled=shows) as progress:
            report = lint(paths, job.settle, progress, child, job.naming, job.changes, signals)
    except (Exception, KeyboardInterrupt) as error:
        job.write_failure(error)
        raise
    if report.run.usd_said and not given["quiet"]:
        said = "; ".join(report.run.usd_said)
        click.echo(f"usdvol-lint: USD could not load all its plugins: {printable(said)}", err=True)
    report = report._replace(run=_run_info(report.run, job.config))
    if report.interrupted:
        return job.end_early(report)
    report, failure = job.prepared.apply(report) if job.prepared else (report, "")
    output.write(report._replace(failure=failure), job.destinations, job.options())
    if job.config.suppress and not given["quiet"]:
        _tell_expired(job.config)
    if failure:
        raise UsageError(failure)
    if given["write_baseline"] is not None:
        return CLEAN
    return exit_code(report, job.config, given["fail_on_unpruned"])


def report_misuse(arguments: Sequence[str], error: Exception) -> None:
    """Writes the reports that a command line asks for which can't be followed.

    None is written where it would be the report of another command, or was written already.
    """
    if _IS_REPORTED in getattr(error, "__notes__", ()) or not _OTHER.isdisjoint(arguments):
        return
    said = list(outputs(list(arguments)))
    written = {value for _, value in said}
    asked = output.named_by(said, [each for each in arguments if each not in written])
    destinations = [each for each in asked if not each.is_text_to_read]
    if not destinations:
        return
    options = output.options_for("never", quiet=False, verbose=False)
    options = options._replace(repository=checkout_of(()))
    output.write(_failed((), error, Config()), destinations, options)


class _Job:
    """What the options and the configuration ask for; it is settled while a worker imports USD."""

    config = Config()
    file: Path | None = None
    destinations: Sequence[Destination] = ()
    prepared: Prepared | None = None
    repository: str | None = None

    def __init__(self, paths: tuple[str, ...], given: dict[str, Any]) -> None:
        self._paths = paths
        self._given = given

    def read_list(self) -> tuple[str, ...]:
        """The arguments, with those in a list."""
        self._paths = arguments(self._paths, self._given)
        return self._paths

    def changes(self, config: Config) -> Changes | None:
        return changes(self._paths, self._given, config, self.file)

    def settle(self) -> Config:
        given = self._given
        self.config, self.file = read_settings(given)
        if self.config.jobs > (most := owned()) and not given["quiet"]:
            click.echo(f"usdvol-lint: {_more_jobs(self.config.jobs, most)}", err=True)
        destinations = output.pair(given["outputs"], self.config.output_format)
        output.check_writable(destinations, self._inputs)
        self.destinations = destinations
        if any(each.format in FOR_HOSTS for each in destinations):
            self.repository = checkout_of(self._paths)
        self.prepared = _prepared(given, self.config)
        return self.config

    def naming(self, config: Config) -> Naming:
        of_baseline = self.prepared.root if self.prepared else None
        folder = str(self.file.parent) if self.file else None
        if config.root is not None and not os.path.isdir(config.root):
            where = config.origins.words("root")
            raise UsageError(f"{where}: the root {quoted(config.root)} is no folder")
        root = root_of(self._paths, self._given["root"], of_baseline, config.root, folder)
        if self.prepared:
            self.prepared.check_root(root)
        return Naming(root, versions_in(config.version_pattern), self.repository)

    def options(self) -> Options:
        return output.options_of(self._given, self.config)._replace(
            fail_on_unpruned=self._given["fail_on_unpruned"],
            category=self._given["category"] or "",
            summary=self._given["summary"] or "",
            repository=self.repository,
            page_of=lambda code: load_for(self.config).page(code),
        )

    @property
    def _inputs(self) -> tuple[str | None, ...]:
        """The files that the run reads, as far as they are named."""
        given = self._given
        named = (given["files_from"], given["baseline"], given["write_baseline"])
        return (*self._paths, *named, self.config.baseline)

    def end_early(self, report: Report) -> int:
        """Writes the reports on what an interrupted run has; a baseline is only compared with."""
        if self.prepared and not self.prepared.use.target:
            report, _ = self.prepared.apply(report)
        output.write(report, self.destinations, self.options())
        click.echo(f"usdvol-lint: {report.failure}; what was found is reported", err=True)
        return ended_by(report.interrupted)

    def write_failure(self, error: BaseException) -> None:
        """Writes the reports that were asked for: a missing one, or that of before, seems clean."""
        asked = self.destinations or output.named_by(self._given["outputs"], self._inputs)
        destinations = [each for each in asked if not each.is_text_to_read]
        if not destinations:
            return
        self.repository = self.repository or checkout_of(self._paths)
        report = _failed(self._paths, error, self.config)
        output.write(report, destinations, self.options())


def _more_jobs(jobs: int, most: int) -> str:
    own = "one processor" if most == 1 else f"{most} processors"
    return f"{jobs} jobs are no faster than {most} here, where this process may use {own}"


def _failed(paths: tuple[str, ...], error: BaseException, config: Config) -> Report:
    """The report on a run that could not begin."""
    words = error.format_message() if isinstance(error, click.ClickException) else str(error)
    is_interrupted = isinstance(error, KeyboardInterrupt)
    if is_interrupted:
        words = "interrupted before any stage was checked"
    return Report(
        version=__version__,
        usd_version=None,
        settings={},
        root=None,
        stages=(),
        causes=(),
        run=_run_info(RunInfo(), config),
        arguments=paths,
        failure=" ".join(words.split()),
        interrupted=signal_of(error) if is_interrupted else 0,
    )


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


def _run_info(run: RunInfo, config: Config) -> RunInfo:
    from datetime import UTC, datetime

    file, *extended = config.origins.files or (None,)
    return run._replace(
        date=datetime.now(UTC).isoformat(timespec="seconds"),
        command=("usdvol-lint", *sys.argv[1:]),
        config_file=file,
        config_extends=tuple(map(str, extended)),
    )
