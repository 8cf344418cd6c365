"""Writes reports while a run goes on, in the formats that need not wait for its end."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import AbstractContextManager, ExitStack, contextmanager, nullcontext
from pathlib import Path
from types import TracebackType
from typing import TypeAlias

from usdvol_lint.command.hosts import Guard, is_github
from usdvol_lint.command.output import TEXTS, Destination, plain
from usdvol_lint.command.writing import Printer, write_to
from usdvol_lint.model import Severity
from usdvol_lint.report import Options, writer
from usdvol_lint.results import Cause, Place, Report, StageResult

Asked: TypeAlias = Callable[[], tuple[Sequence[Destination], Options]]
"""The reports that are to be written while the run goes on, and how; known once it begins."""
Write: TypeAlias = Callable[[Iterable[str]], None]


class Streams:
    """Is told of a run, and writes what is known after each stage.

    What goes to standard output is written `aside` of the progress bar; a file is there as a whole
    once the run is over, or not at all.
    """

    def __init__(
        self, asked: Asked, aside: Callable[[], AbstractContextManager[None]] = nullcontext
    ) -> None:
        self._asked = asked
        self._aside = aside
        self._streams: list[_Stream] = []
        self._printer = Printer()

    def __enter__(self) -> Streams:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        for stream in self._streams:
            stream.drop()

    def begin(self, head: Report) -> None:
        destinations, options = self._asked()
        for destination in destinations:
            self._streams.append(_Stream(destination, options, self._print))
        for stream in self._streams:
            stream.keep(stream.writer.begin(head))

    @property
    def listening(self) -> bool:
        """Whether any report is written while the run goes on."""
        return bool(self._streams)

    def cause(self, number: int, cause: Cause) -> None:
        for stream in self._streams:
            stream.keep(stream.writer.cause(number, cause))

    def place(self, number: int, place: Place) -> None:
        for stream in self._streams:
            stream.keep(stream.writer.place(number, place))

    def raised(self, number: int, cause: Cause, was: Severity) -> None:
        for stream in self._streams:
            stream.keep(stream.writer.raised(number, cause, was))

    def stage(self, number: int, stage: StageResult) -> None:
        for stream in self._streams:
            stream.keep(stream.writer.stage(number, stage))
            stream.write()

    def end(self, report: Report) -> frozenset[Destination]:
        """Writes the rest, and returns which reports are written; others may be tried again."""
        for stream in self._streams:
            stream.keep(stream.writer.end(report))
            stream.close()
        return frozenset(each.destination for each in self._streams if not each.has_failed)

    def check(self) -> None:
        """Raises UsageError where not all could be printed."""
        self._printer.close()

    def fail(self, report: Report) -> frozenset[Destination]:
        """The same after a run that broke off, whose end is for programs: people read why."""
        told = [each for each in self._streams if each.destination.file is None]
        for stream in told:
            is_for_people = stream.destination.is_text_to_read
            writer = stream.writer
            stream.keep(writer.held() if is_for_people else writer.end(report))
            stream.close()
        return frozenset(each.destination for each in told)

    def _print(self, parts: Iterable[str]) -> None:
        with self._aside():
            self._printer.print(parts)


class _Stream:
    """One report, its parts kept until there is a stage to write them with."""

    def __init__(
        self,
        destination: Destination,
        options: Options,
        show: Write,
    ) -> None:
        self.destination = destination
        self.has_failed = False
        self._parts: list[str] = []
        self._open = ExitStack()
        if destination.file is None:
            self.writer = writer(destination.format, options)
            self._write = self._printing(show)
        else:
            self.writer = writer(destination.format, plain(options))
            self._write = self._writing(destination.file)

    def keep(self, parts: Iterable[str]) -> None:
        self._parts += parts

    def write(self) -> None:
        """Writes what was kept; what can't be written is written once the run is over, or said."""
        parts, self._parts = self._parts, []
        if parts and not self.has_failed:
            with self._failing():
                self._write(parts)

    def close(self) -> None:
        self.write()
        with self._failing():
            self._open.close()

    def drop(self) -> None:
        """Leaves no file that is not whole."""
        error = GeneratorExit()
        self._open.__exit__(type(error), error, None)

    def _printing(self, show: Write) -> Write:
        if not (is_github() and self.destination.format in TEXTS):
            return show
        guard = Guard()
        self._open.callback(lambda: show(guard.closed()))
        return lambda parts: show(guard.opened(parts))

    def _writing(self, file: str) -> Write:
        with self._failing():
            stream = self._open.enter_context(write_to(Path(file)))
            return lambda parts: stream(parts)
        return lambda parts: None

    @contextmanager
    def _failing(self) -> Iterator[None]:
        try:
            yield
        except OSError:
            self.has_failed = True
            self.drop()
