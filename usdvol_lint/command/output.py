"""Writes reports, each in its format, to standard output or files."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import click

from usdvol_lint.command.hosts import add_summary, guarded, is_github, summary_file
from usdvol_lint.command.writing import Printer, is_device, write_to
from usdvol_lint.config import Config
from usdvol_lint.model import Severity, UsageError
from usdvol_lint.paths import canonical, is_called_like_input
from usdvol_lint.report import FORMATS, Options, written
from usdvol_lint.results import Report
from usdvol_lint.words import printable

AUTO = "auto"
FORMAT, FILE = "--output-format", "--output"
TEXTS = frozenset({"full", "concise"})
MACHINE_FORMATS = frozenset(FORMATS) - TEXTS

_NO_REPORTS = ("explain", "list_rules", "test", "show_settings", "show_files")


class Destination(NamedTuple):
    """Where one report goes: its format, and its file, or None for standard output.

    What `is_added` goes below what others wrote to the file, which is the host's.
    """

    format: str
    file: str | None
    is_added: bool = False

    @property
    def is_text_to_read(self) -> bool:
        """Whether it is for a person, who sees what is said on standard error too."""
        return self.file is None and self.format in TEXTS


def pair(said: Sequence[tuple[str, str]], default: str) -> list[Destination]:
    """The reports that options ask for: `said` are `--output-format` and `--output`, in order.

    A file goes with the format before it, or else with that after it; a format without a file is
    for standard output, as is the file `-`.
    If all are files in formats for programs, a text report is added for standard output, and in a
    job of GitHub also where the text goes to a file: the log would have nothing.
    Raises UsageError where the numbers don't match or a file is named twice.
    """
    destinations = list(_paired(said, default))
    files = [each.file for each in destinations if each.file is not None]
    if len(destinations) - len(files) > 1:
        raise UsageError("only one report can go to standard output: give the others an --output")
    if len({os.path.abspath(file) for file in files}) < len(files):
        raise UsageError("one file can't take several reports: name each --output once")
    if files and all(map(_is_beside_the_log, destinations)):
        destinations.append(Destination(AUTO, None))
    return [each for destination in destinations for each in _expanded(destination)]


def _paired(said: Sequence[tuple[str, str]], default: str) -> Iterator[Destination]:
    formats = sum(option == FORMAT for option, _ in said)
    files = len(said) - formats
    if files > max(formats, 1):
        raise UsageError(
            f"--output is given {_times(files)}, --output-format {_times(formats)}: "
            "name a format for each file, before it"
        )
    format: str | None = None
    file: str | None = None
    for option, value in said:
        if option == FORMAT:
            if format is not None:
                yield Destination(format, None)
            format = value
        elif file is not None:
            yield Destination(default, _file(file))
            file = value
        else:
            file = value
        if format is not None and file is not None:
            yield Destination(format, _file(file))
            format = file = None
    if format is not None or file is not None or not said:
        yield Destination(format or default, _file(file))


def _is_beside_the_log(destination: Destination) -> bool:
    """Whether a report leaves open what is printed; in a job of GitHub also the text in a file."""
    is_text = destination.format not in MACHINE_FORMATS
    is_left_to_us = destination.format == AUTO and is_github()
    return bool(destination.file) and (not is_text or is_left_to_us)


def _file(value: str | None) -> str | None:
    return None if value == "-" else value


def _expanded(destination: Destination) -> Iterator[Destination]:
    """What a destination comes to where it is up to us: the text, and what a job of GitHub has."""
    if destination.format != AUTO:
        yield destination
        return
    yield destination._replace(format="full")
    if destination.file is None and is_github():
        yield Destination("github", None)
        if file := summary_file():
            yield Destination("markdown", file, is_added=True)


def named_by(said: Sequence[tuple[str, str]], inputs: Sequence[str | None]) -> list[Destination]:
    """The reports that the command line asks for, if they can be written whatever else is wrong."""
    try:
        destinations = pair(said, AUTO)
    except UsageError:
        return []
    return [each for each in destinations if each.format in FORMATS and _is_writable(each, inputs)]


def _is_writable(destination: Destination, inputs: Sequence[str | None]) -> bool:
    try:
        check_writable([destination], inputs)
    except UsageError:
        return False
    return True


def _times(number: int) -> str:
    return {0: "never", 1: "once", 2: "twice"}.get(number, f"{number} times")


def check_report(given: dict[str, Any]) -> None:
    """Raises UsageError where `--output` is to take what is no report."""
    for name in _NO_REPORTS:
        if given[name] not in (None, False):
            said = f"--output is for reports, and --{name.replace('_', '-')} writes none"
            raise click.UsageError(f"{said}: leave it out, and redirect what is printed")


def check_writable(destinations: Sequence[Destination], inputs: Iterable[str | None]) -> None:
    """Raises UsageError, before any work, where a file can't be written, or is an input."""
    read = {canonical(each) for each in inputs if each}
    for destination in destinations:
        if destination.file is None or destination.is_added:
            continue
        file = Path(destination.file)
        if is_called_like_input(destination.file):
            raise UsageError(
                f"--output {destination.file}: a report is not written to a file that is called "
                "like an input: name another one"
            )
        if os.path.isdir(file) or not os.path.basename(destination.file):
            raise UsageError(f"--output {destination.file}: this is a folder, name a file")
        if canonical(destination.file) in read:
            said = "the run reads this file: name another one"
            raise UsageError(f"--output {destination.file}: {said}")
        if not os.path.isdir(file.parent):
            raise UsageError(f"--output {destination.file}: there is no folder {file.parent}")
        if not os.access(file if is_device(file) else file.parent, os.W_OK):
            raise UsageError(f"--output {destination.file}: no permission to write there")


def write(report: Report, destinations: Sequence[Destination], options: Options) -> None:
    """Renders and writes every report; a file is replaced as a whole or not at all.

    A report whose file can't be written goes to standard output; once all reports are written, a
    UsageError names these files.
    """
    failures = []
    for_files = plain(options)
    for destination in destinations:
        format, file, _ = destination
        if file is None:
            parts = written(report, format, options)
            print_text(guarded(parts) if format in TEXTS and is_github() else parts)
            continue
        try:
            _write_file(destination, file, report, for_files)
        except OSError as error:
            if destination.is_added:  # the host's own, for which nobody asked
                said = f"the summary of the step (GITHUB_STEP_SUMMARY) can't be written: {file}"
                print(f"usdvol-lint: {printable(said)}: {error.strerror}", file=sys.stderr)
                continue
            failures.append(f"--output {file}: {error.strerror}")
            print_text(written(report, format, for_files))
    if failures:
        raise UsageError("; ".join(failures))


def plain(options: Options) -> Options:
    """The options for a report in a file."""
    return options._replace(color=False, width=80, quiet=False)


def _write_file(destination: Destination, file: str, report: Report, options: Options) -> None:
    if destination.is_added:
        add_summary(Path(file), report, options)
    else:
        _replace(Path(file), written(report, destination.format, options))


def options_of(given: dict[str, Any], config: Config | None = None) -> Options:
    """The options for reports that the command line and the configuration ask for."""
    options = options_for(given["color"], given["quiet"], given["verbose"])
    if config is None:
        return options
    fail_on = None if config.fail_on == "never" else Severity[config.fail_on.upper()]
    return options._replace(
        least=config.least_shown,
        show=frozenset(config.show),
        fail_on=fail_on,
        fail_on_unchecked=config.fail_on_unchecked,
    )


def options_for(color: str, quiet: bool, verbose: bool) -> Options:
    """The options for a report on standard output; `color` is auto, always or never."""
    wanted = color == "always" or (color == "auto" and _terminal_wants_color())
    width = shutil.get_terminal_size().columns
    return Options(color=wanted, width=width, quiet=quiet, verbose=verbose)


def _terminal_wants_color() -> bool:
    """Follows no-color.org and force-color.org, as rich does."""
    if os.environ.get("NO_COLOR"):
        return False
    if os.environ.get("FORCE_COLOR"):
        return True
    return sys.stdout is not None and sys.stdout.isatty() and os.environ.get("TERM") != "dumb"


def print_text(parts: Iterable[str]) -> None:
    """Writes text as UTF-8 whatever the locale, which may lack characters of a stage's names."""
    printer = Printer()
    printer.print(parts)
    printer.close()


def _replace(file: Path, parts: Iterable[str]) -> None:
    with write_to(file) as write:
        write(parts)
