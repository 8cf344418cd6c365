"""The output formats: each is a module with a `Writer`, imported when used."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from importlib import import_module
from itertools import islice
from typing import TYPE_CHECKING, Final, NamedTuple

from usdvol_lint.model import Severity

if TYPE_CHECKING:
    from usdvol_lint.packs.page import Page
    from usdvol_lint.results import Cause, Place, Report, StageResult

FORMATS: Final[Mapping[str, str]] = {
    "full": "text.Full",
    "concise": "concise.Concise",
    "json": "json_report.Json",
    "jsonl": "json_lines.JsonLines",
    "sarif": "sarif.Sarif",
    "github": "github.GitHub",
    "gitlab": "gitlab.GitLab",
    "junit": "junit.JUnit",
    "markdown": "markdown.Markdown",
}
"""By the name of each format the module of this package, and the `Writer` in it."""
STREAMED: Final = frozenset({"full", "concise", "jsonl"})
"""Those that tell a cause before the rest of the run is known."""
FOR_HOSTS: Final = frozenset({"sarif", "github", "gitlab"})
"""Those that name files by the repository of a code host."""


def no_page(code: str) -> Page | None:
    """The page of a rule where nobody has any."""
    return None


class Options(NamedTuple):
    """How to write a report; a format may ignore some of it.

    `width` is that of the terminal in cells: with `color`, the text report is wrapped to it.
    Reports for people have causes from the severity `least` on; `verbose` shows all of them.
    What is `known` or `suppressed` is there only where `show` names it, and then all of it.
    From `fail_on` on a cause fails the run, from no level on where it is None; with
    `fail_on_unchecked` also one that says that something was not checked, and with
    `fail_on_unpruned` an entry of the baseline that is gone.
    `summary` asks the text report for a table alone, by rule, cause, stage or asset.
    Reports for code hosts name files in relation to `repository`, a canonical folder, and keep the
    uploads of one run apart by `category`; `page_of` gives the page of a rule by its code.
    """

    color: bool = False
    width: int = 80
    quiet: bool = False
    verbose: bool = False
    least: Severity = Severity.WARNING
    show: frozenset[str] = frozenset()
    fail_on: Severity | None = Severity.ERROR
    fail_on_unchecked: bool = False
    fail_on_unpruned: bool = False
    repository: str | None = None
    category: str = ""
    summary: str = ""
    page_of: Callable[[str], Page | None] = no_page

    @property
    def threshold(self) -> Severity:
        """The severity from which on reports for people have a cause."""
        return Severity.INFO if self.verbose else self.least

    def shows(self, cause: Cause) -> bool:
        """Whether a report for people has this cause."""
        if not cause.state.counts:
            return cause.state in self.show
        return cause.severity >= self.threshold or self.fails_unchecked(cause)

    def fails(self, cause: Cause) -> bool:
        """Whether this cause fails the run."""
        if self.fails_unchecked(cause):
            return True
        return self.fail_on is not None and cause.state.counts and cause.severity >= self.fail_on

    def fails_unchecked(self, cause: Cause) -> bool:
        return self.fail_on_unchecked and cause.is_unchecked


class Writer:
    """Writes a report in one format: the text of each part follows that of the one before.

    What a run came to is told in this order, whether or not it is over: `begin` once; for each
    stage a `cause` for what is seen for the first time, and a `place` for each other place that it
    carries, or `raised` where one is worse than before, then `stage`; after the last stage causes
    that were known no sooner, and `end` once.
    A format that needs the whole report for its first line writes all of it at the end.
    """

    def __init__(self, options: Options) -> None:
        self.options = options

    def begin(self, report: Report) -> Iterable[str]:
        """What stands before the first cause; the report has neither stages nor causes yet."""
        return ()

    def cause(self, number: int, cause: Cause) -> Iterable[str]:
        """A cause, with its number in the run, and what is known of it so far."""
        return ()

    def place(self, number: int, place: Place) -> Iterable[str]:
        """Another place of the cause with that number."""
        return ()

    def raised(self, number: int, cause: Cause, was: Severity) -> Iterable[str]:
        """A cause that `was` told at a lower level, with the place that raises it."""
        return ()

    def stage(self, number: int, stage: StageResult) -> Iterable[str]:
        """What came of a stage; what waits for the rest of the run is not in it."""
        return ()

    def held(self) -> Iterable[str]:
        """What was told and waits to be written, where the run breaks off and has no end."""
        return ()

    def end(self, report: Report) -> Iterable[str]:
        """What stands after the last cause and the last stage."""
        return ()


def writer(format: str, options: Options) -> Writer:
    """What writes a report in one of FORMATS."""
    module, _, name = FORMATS[format].partition(".")
    made: Writer = getattr(import_module(f"{__name__}.{module}"), name)(options)
    return made


def written(report: Report, format: str, options: Options) -> Iterator[str]:
    """The parts of a report in one of FORMATS: none, or with a newline at the end of the last."""
    wanted = writer(format, options)
    yield from wanted.begin(report._replace(stages=(), causes=()))
    yield from _told(wanted, report)
    yield from wanted.end(report)


def _told(writer: Writer, report: Report) -> Iterator[str]:
    """The causes by number, and the stages, each after the causes that are first seen on it."""
    stages = iter(enumerate(report.stages))
    done = 0
    for number, cause in enumerate(report.causes):
        for stage in islice(stages, max(0, cause.places[0].stage - done)):
            yield from writer.stage(*stage)
            done += 1
        yield from writer.cause(number, cause)
        for place in cause.places[1:]:
            yield from writer.place(number, place)
    for stage in stages:
        yield from writer.stage(*stage)


def render(report: Report, format: str, options: Options) -> str:
    """The whole report in one of FORMATS."""
    return "".join(written(report, format, options))
