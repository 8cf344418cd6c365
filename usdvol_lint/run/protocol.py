"""The messages between the parent and a worker process, pickled over two pipes, some at a time.

After `Setup` the parent sends paths, and the worker answers each with `Done`, in their order.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from typing import Any, Final, NamedTuple, TypeAlias, TypeVar

from usdvol_lint.config import Depth
from usdvol_lint.model import Cover, Excerpt, Finding, Severity, Site, Source, StageReport, Status
from usdvol_lint.packs.activation import ActiveRules
from usdvol_lint.suppressions import InStages

SHORT = 0.02
"""Seconds that a small stage takes at most."""

_SEVERITIES: Final = {int(each): each for each in Severity}
_STATUSES: Final = {each.value: each for each in Status}

_Columns: TypeAlias = tuple[Any, ...]
_Row = TypeVar("_Row", bound=tuple[Any, ...])


class Setup(NamedTuple):
    """The parent's first message: the rules to run, and how stages are to be checked.

    `is_alone` says that there is but one stage in the run, and `are_many` that there are so many
    that most of them are probably small; `workers` is how many there are at most.
    `repository` says that findings in layers outside that folder need a line in the stage's own
    file.
    Where some files are `changed`, a stage that uses none of them is not checked.
    """

    active: ActiveRules
    packs: tuple[str, ...]
    depth: Depth
    suppressions: InStages
    is_alone: bool = False
    are_many: bool = False
    workers: int = 1
    repository: str | None = None
    changed: frozenset[str] | None = None


class Ready(NamedTuple):
    """The worker's answer to Setup; `said` is what USD said of its own plugins."""

    usd_version: str
    said: tuple[str, ...] = ()


class Refusal(NamedTuple):
    """The worker's answer to Setup if it can't load USD or the rules."""

    reason: str


class NewFindings(NamedTuple):
    """Findings on a stage since the last such message; more messages about the stage follow.

    They are the columns of a table, those of `site`, `source` and `cover` by themselves: so hardly
    any code of Python's runs for each finding, as it does where named tuples are pickled.
    """

    number: int
    columns: _Columns
    sites: _Columns
    sources: _Columns
    covers: _Columns

    @classmethod
    def of(cls, findings: Sequence[Finding]) -> NewFindings:
        code, name, severity, message, sites, sources, covers, *rest = zip(*findings, strict=True)
        *where, excerpts, entry = zip(*sites, strict=True)
        level, *extent = zip(*_short(covers), strict=True)
        plain = tuple([each and (each.text, each.column) for each in excerpts])
        return cls(
            len(findings),
            _shortened(code, name, tuple(map(int, severity)), message, *rest),
            _shortened(*where, plain, entry),
            _shortened(*zip(*sources, strict=True)),
            (tuple(map(int, level)), *extent),
        )

    @property
    def findings(self) -> Iterator[Finding]:
        code, name, severity, message, *rest = self.columns
        *where, excerpt, entry = self.sites
        level, *extent = self.covers
        excerpts = tuple([each and Excerpt(*each) for each in excerpt])
        sites = _rows(Site, self.number, *where, excerpts, entry)
        sources = _rows(Source, self.number, *self.sources)
        covers = _rows(Cover, len(level), _levels(level), *extent)
        said = (code, name, _levels(severity), message, sites, sources, covers, *rest)
        return iter(_rows(Finding, self.number, *said))


def _levels(numbers: tuple[int, ...]) -> tuple[Severity, ...]:
    return tuple(map(_SEVERITIES.__getitem__, numbers))


def _shortened(*columns: tuple[Any, ...]) -> _Columns:
    return tuple(map(_short, columns))


def _short(column: tuple[Any, ...]) -> tuple[Any, ...]:
    """A column, with one value in the place of many that are equal."""
    first = column[0]
    is_even = first == column[-1] and column.count(first) == len(column)
    return (first,) if is_even else column


def _rows(kind: type[_Row], number: int, *columns: tuple[Any, ...]) -> tuple[_Row, ...]:
    """So many named tuples, made without their own constructor, which is Python's."""
    full = [each * number if len(each) == 1 else each for each in columns]
    return tuple(map(partial(tuple.__new__, kind), zip(*full, strict=True)))


class Done(NamedTuple):
    """The report on a stage, the last message about it: its findings were sent before.

    `order` are the numbers of those that the report has, in its order, among all that were sent,
    or findings that were not.
    """

    report: StageReport
    order: tuple[int | Finding, ...]

    def __reduce__(self) -> tuple[Any, ...]:
        """As plain values, since most stages have no more to tell."""
        path, status, stats, findings, *rest = self.report
        return _done, (self.order, path, status.value, stats, findings, *rest)

    def with_findings(self, sent: Sequence[Finding]) -> StageReport:
        """The whole report."""
        if not self.order:
            return self.report
        found = [sent[each] if isinstance(each, int) else each for each in self.order]
        return self.report._replace(findings=tuple(found))


def _done(order: tuple[int | Finding, ...], path: str, status: str, *rest: Any) -> Done:
    return Done(StageReport(path, _STATUSES[status], *rest), order)


class Together(NamedTuple):
    """That so many stages are looked at side by side from now on; more messages follow.

    Of one it says that those which were are looked at one after the other.
    """

    stages: int


class GivenUp(NamedTuple):
    """The report on a stage that USD would have been busy with for ever, and the last message."""

    report: StageReport


class Advance(NamedTuple):
    """Samples of a long sequence read since the last such message; more messages follow."""

    samples: int


Reply: TypeAlias = Ready | Refusal | Together | Advance | NewFindings | GivenUp | Done
"""What a worker says."""
