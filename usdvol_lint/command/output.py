"""Where reports go: standard output or files, each in its format."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from usdvol_lint.model import Report, UsageError
from usdvol_lint.report import FORMATS, Options, render

MACHINE_FORMATS = frozenset(FORMATS) - {"full", "concise"}


class Destination(NamedTuple):
    """One report: its format, and its file or None for standard output."""

    format: str
    file: str | None


def pair(formats: Sequence[str], files: Sequence[str], default: str) -> list[Destination]:
    """Formats and files in the order given; one format, the last, goes to standard output.

    Beside files for machines the terminal still gets a text report.
    """
    named = list(formats) or [default]
    if len(files) > len(named):
        raise UsageError(f"{len(files)} times --output, but {len(named)} times --output-format")
    if len(named) - len(files) > 1:
        raise UsageError("only one report can go to standard output: give the others an --output")
    if len({os.path.abspath(file) for file in files}) < len(files):
        raise UsageError("one file can't take several reports: name each --output once")
    destinations = [
        Destination(format, files[index] if index < len(files) else None)
        for index, format in enumerate(named)
    ]
    if files and all(d.file and d.format in MACHINE_FORMATS for d in destinations):
        destinations.append(Destination("full", None))
    return destinations


def check_writable(destinations: Sequence[Destination]) -> None:
    """Finds out before the work whether its result can be kept."""
    for destination in destinations:
        if destination.file is None:
            continue
        file = Path(destination.file)
        if os.path.isdir(file):
            raise UsageError(f"--output {destination.file}: this is a folder, name a file")
        if not os.path.isdir(file.parent):
            raise UsageError(f"--output {destination.file}: there is no folder {file.parent}")
        if not os.access(file if _is_device(file) else file.parent, os.W_OK):
            raise UsageError(f"--output {destination.file}: no permission to write there")


def write(report: Report, destinations: Sequence[Destination], options: Options) -> None:
    """Renders and writes every report; files appear whole or not at all.

    A file that can't be written is said when all others are out, its report on standard output.
    """
    failures = []
    for destination in destinations:
        if destination.file is None:
            print_text(render(report, destination.format, options))
            continue
        text = render(report, destination.format, Options(verbose=options.verbose))
        try:
            _replace(Path(destination.file), text)
        except OSError as error:
            failures.append(f"--output {destination.file}: {error.strerror}")
            print_text(text)
    if failures:
        raise UsageError("; ".join(failures))


def options_for(color: str, quiet: bool, verbose: bool) -> Options:
    """How standard output wants its report."""
    wanted = color == "always" or (color == "auto" and _terminal_wants_color())
    width = shutil.get_terminal_size().columns
    return Options(color=wanted, width=width, quiet=quiet, verbose=verbose)


def _terminal_wants_color() -> bool:
    """By the conventions of no-color.org and force-color.org, which rich follows too."""
    if os.environ.get("NO_COLOR"):
        return False
    if os.environ.get("FORCE_COLOR"):
        return True
    return sys.stdout is not None and sys.stdout.isatty() and os.environ.get("TERM") != "dumb"


def print_text(text: str) -> None:
    """Writes text as UTF-8 whatever the locale: names in a stage are not bound to it."""
    if sys.stdout is None:
        raise UsageError("there is no standard output to print to")
    try:
        sys.stdout.flush()
        sys.stdout.buffer.write(text.encode("utf-8", "backslashreplace"))
        sys.stdout.buffer.flush()
    except OSError as error:
        # What is still in the buffer must not fail once more when Python ends.
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        # Where the reader went away, as `head` does, there is nobody to tell.
        if not isinstance(error, BrokenPipeError):
            raise UsageError(f"can't write to standard output: {error.strerror}") from error


def _replace(file: Path, text: str) -> None:
    contents = text.encode("utf-8", "backslashreplace")
    if _is_device(file):
        file.write_bytes(contents)
        return
    target = Path(os.path.realpath(file))
    temporary = target.with_name(f".{target.name}.{os.getpid()}.tmp")
    try:
        temporary.write_bytes(contents)
        temporary.replace(target)
    finally:
        temporary.unlink(missing_ok=True)


def _is_device(file: Path) -> bool:
    """Whether the file is there and not one to replace, such as /dev/null or a pipe."""
    return os.path.exists(file) and not os.path.isfile(file)
