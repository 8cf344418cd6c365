"""Lints stages as the options of the command line say, and writes what they ask for."""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING, Any

import click

from usdvol_lint.command import output
from usdvol_lint.command.choosing import arguments, changes
from usdvol_lint.command.codes import CLEAN, ended_by, exit_code, signal_of
from usdvol_lint.command.failed import failed, mark_reported, run_info, write_failed
from usdvol_lint.command.progress import ProgressBar
from usdvol_lint.command.settings import read_settings
from usdvol_lint.command.streaming import Streams
from usdvol_lint.config import Config
from usdvol_lint.model import UsageError
from usdvol_lint.packs.catalog import NOT_IGNORABLE, load_for
from usdvol_lint.report import FOR_HOSTS, STREAMED
from usdvol_lint.results import Report
from usdvol_lint.run.causes import versions_in
from usdvol_lint.run.interruption import Interruption, name_of
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


def lint_stages(
    paths: tuple[str, ...],
    given: dict[str, Any],
    child: Popen[bytes] | None = None,
    signals: Interruption | None = None,
) -> int:
    """Lints stages as the options say, writes what they ask for, and returns the exit code.

    `given` are the options by their names in Python; `child` is the first worker process, `signals`
    what hears them.
    """
    signals = signals or Interruption()
    try:
        code = _linted(paths, given, child, signals)
    except KeyboardInterrupt as error:
        number = signal_of(error)
        return _tell_end(number, f"interrupted by {name_of(number)}")
    except Exception as error:
        mark_reported(error)
        raise
    if signals.number and not signals.is_early:
        name = name_of(signals.number)
        return _tell_end(signals.number, f"interrupted by {name} once all stages were done")
    return code


def _linted(
    paths: tuple[str, ...],
    given: dict[str, Any],
    child: Popen[bytes] | None,
    signals: Interruption,
) -> int:
    job = _Job(paths, given)
    shows = not given["quiet"] and sys.stderr.isatty()
    with ProgressBar(enabled=shows) as progress, Streams(job.streamed, progress.aside) as streams:
        try:
            signals.release()
            paths = job.read_list()
            report = lint(
                paths, job.settle, progress, child, job.naming, job.changes, signals, streams
            )
            signals.hold()
        except (Exception, KeyboardInterrupt) as error:
            signals.hold()
            job.write_failure(error, streams)
            raise
        progress.close()
        return _ended(job, report, streams)


def _ended(job: _Job, report: Report, streams: Streams) -> int:
    """Writes what is not written yet, and returns the exit code."""
    given = job.given
    if report.run.usd_said and not given["quiet"]:
        said = "; ".join(report.run.usd_said)
        click.echo(f"usdvol-lint: USD could not load all its plugins: {printable(said)}", err=True)
    report = report._replace(run=run_info(report.run, job.config))
    if report.interrupted:
        return job.end_early(report, streams)
    report, failure = job.prepared.apply(report) if job.prepared else (report, "")
    job.write(report._replace(failure=failure), streams)
    if not given["quiet"]:
        _tell_without_rules(report)
    if job.config.suppress and not given["quiet"]:
        _tell_expired(job.config)
    if failure:
        raise UsageError(failure)
    if given["write_baseline"] is not None:
        return CLEAN
    return exit_code(report, job.config, given["fail_on_unpruned"])


class _Job:
    """What the options and the configuration ask for; it is settled while a worker imports USD."""

    config = Config()
    file: Path | None = None
    destinations: Sequence[Destination] = ()
    prepared: Prepared | None = None
    repository: str | None = None

    def __init__(self, paths: tuple[str, ...], given: dict[str, Any]) -> None:
        self._paths = paths
        self.given = given

    def read_list(self) -> tuple[str, ...]:
        """The arguments, with those in a list."""
        self._paths = arguments(self._paths, self.given)
        return self._paths

    def changes(self, config: Config) -> Changes | None:
        return changes(self._paths, self.given, config, self.file)

    def settle(self) -> Config:
        given = self.given
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
        root = root_of(self._paths, self.given["root"], of_baseline, config.root, folder)
        if self.prepared:
            self.prepared.check_root(root)
        return Naming(root, versions_in(config.version_pattern), self.repository)

    def options(self) -> Options:
        return output.options_of(self.given, self.config)._replace(
            fail_on_unpruned=self.given["fail_on_unpruned"],
            category=self.given["category"] or "",
            summary=self.given["summary"] or "",
            repository=self.repository,
            page_of=lambda code: load_for(self.config).page(code),
        )

    @property
    def _inputs(self) -> tuple[str | None, ...]:
        """The files that the run reads, as far as they are named."""
        given = self.given
        named = (given["files_from"], given["baseline"], given["write_baseline"])
        return (*self._paths, *named, self.config.baseline)

    def streamed(self) -> tuple[Sequence[Destination], Options]:
        """The reports to write while the run goes on.

        None where the states of causes, or what was looked at, is not known before its end.
        """
        given = self.given
        waits = self.prepared or given["summary"] or given["changed_since"] is not None
        asked = () if waits else self.destinations
        return [each for each in asked if each.format in STREAMED], self.options()

    def write(self, report: Report, streams: Streams) -> None:
        """Writes the reports, or what is left of those that were written meanwhile."""
        done = streams.end(report)
        left = [each for each in self.destinations if each not in done]
        output.write(report, left, self.options())
        streams.check()

    def end_early(self, report: Report, streams: Streams) -> int:
        """Writes the reports on what an interrupted run has; a baseline is only compared with."""
        if self.prepared and not self.prepared.use.target:
            report, _ = self.prepared.apply(report)
        self.write(report, streams)
        return _tell_end(report.interrupted, f"{report.failure}; what was found is reported")

    def write_failure(self, error: BaseException, streams: Streams) -> None:
        """Writes the reports that were asked for, and ends those that were begun."""
        asked = self.destinations or output.named_by(self.given["outputs"], self._inputs)
        done = streams.fail(failed(self._paths, error, self.config))
        left = [each for each in asked if each not in done]
        write_failed(left, self._paths, error, self.config, self.options())


def _tell_end(number: int, said: str) -> int:
    """What a run exits with that a signal ended; says so if the terminal is still there."""
    with suppress(OSError):
        click.echo(f"usdvol-lint: {said}", err=True)
    return ended_by(number)


def _more_jobs(jobs: int, most: int) -> str:
    own = "one processor" if most == 1 else f"{most} processors"
    return f"{jobs} jobs are no faster than {most} here, where this process may use {own}"


def _prepared(given: dict[str, Any], config: Config) -> Prepared | None:
    """The baseline in use, read; runs without one import nothing for it."""
    asking = ("write_baseline", "prune_baseline", "fail_on_unpruned", "moved")
    if config.baseline is None and not any(given[name] for name in asking):
        return None
    from usdvol_lint.command.baselines import prepared

    return prepared(given, config)


def _tell_without_rules(report: Report) -> None:
    """Says on standard error that nothing was looked for, which a clean report does not show."""
    rules = report.settings["rules"]
    if report.stages and isinstance(rules, Mapping) and rules.keys() <= NOT_IGNORABLE:
        said = "no rule is on, as `select` and `ignore` say: only what can't be read is told"
        click.echo(f"usdvol-lint: {said}", err=True)


def _tell_expired(config: Config) -> None:
    """Says on standard error why what a table of the configuration suppressed is back."""
    from usdvol_lint.run.suppressing import expired

    for line in expired(config):
        click.echo(f"usdvol-lint: {line}", err=True)
