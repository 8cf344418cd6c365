"""The reports of a run that could not begin: a missing one, or that of before, seems clean."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING

import click

from usdvol_lint import __version__
from usdvol_lint.command import output
from usdvol_lint.command.arguments import outputs, values_of
from usdvol_lint.command.codes import signal_of
from usdvol_lint.config import Config
from usdvol_lint.model import UsageError
from usdvol_lint.results import Report, RunInfo
from usdvol_lint.run.interruption import name_of
from usdvol_lint.run.roots import checkout_of

if TYPE_CHECKING:
    from usdvol_lint.command.output import Destination
    from usdvol_lint.report import Options

_IS_REPORTED = "what is wrong is in the reports"
_OTHER = frozenset({"--explain", "--list-rules", "--show-settings", "--show-files", "--test"})


def mark_reported(error: BaseException) -> None:
    """Says of what was raised that `report_misuse` need not write it."""
    error.add_note(_IS_REPORTED)


def report_misuse(arguments: Sequence[str], error: Exception) -> None:
    """Writes the reports that a command line asks for which can't be followed.

    None is written where it would be the report of another command, or was written already.
    """
    if _IS_REPORTED in getattr(error, "__notes__", ()) or not _OTHER.isdisjoint(arguments):
        return
    said = list(outputs(arguments))
    written = {value for _, value in said}
    asked = output.named_by(said, [each for each in arguments if each not in written])
    category = [value for _, value in values_of(arguments, ("--category",))][-1:]
    options = output.options_for("never", quiet=False, verbose=False)
    write_failed(asked, (), error, Config(), options._replace(category="".join(category)))


def write_failed(
    asked: Sequence[Destination],
    paths: tuple[str, ...],
    error: BaseException,
    config: Config,
    options: Options,
) -> None:
    """Writes the reports that are for programs; people are told on standard error."""
    if destinations := [each for each in asked if not each.is_text_to_read]:
        options = options._replace(repository=options.repository or checkout_of(paths))
        output.write(failed(paths, error, config), destinations, options)


def failed(paths: tuple[str, ...], error: BaseException, config: Config) -> Report:
    """The report on a run that broke off."""
    return Report(
        version=__version__,
        usd_version=None,
        settings={},
        root=None,
        stages=(),
        causes=(),
        run=run_info(RunInfo(), config),
        arguments=paths,
        failure=_words(error),
        interrupted=signal_of(error) if isinstance(error, KeyboardInterrupt) else 0,
    )


def _words(error: BaseException) -> str:
    match error:
        case click.ClickException():
            return error.format_message()
        case KeyboardInterrupt():
            return f"interrupted by {name_of(signal_of(error))} before any stage was checked"
        case UsageError():
            return str(error)
        case _:  # its text may have many lines
            return "internal error: " + " ".join(f"{type(error).__name__}: {error}".split())


def run_info(run: RunInfo, config: Config) -> RunInfo:
    """What a run was called with, and when, beside what is known of it."""
    from datetime import UTC, datetime

    file, *extended = config.origins.files or (None,)
    return run._replace(
        date=datetime.now(UTC).isoformat(timespec="seconds"),
        command=("usdvol-lint", *sys.argv[1:]),
        config_file=file,
        config_extends=tuple(map(str, extended)),
    )
