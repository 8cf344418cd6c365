"""The messages between the parent and a worker process, pickled over two pipes.

After `Setup` the parent sends paths, and the worker answers each with `Done`.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any, NamedTuple

from usdvol_lint.config import Depth
from usdvol_lint.model import Cover, Excerpt, Finding, Site, Source, StageReport
from usdvol_lint.packs.activation import ActiveRules
from usdvol_lint.suppressions import InStages

_PARTS = Finding._fields.index("site")
_EXCERPT = Site._fields.index("excerpt")


class Setup(NamedTuple):
    """The parent's first message: the rules to run, and how stages are to be checked.

    `is_alone` says that there is but one stage in the run, `repository` that findings in layers
    outside that folder need a line in the stage's own file.
    Where some files are `changed`, a stage that uses none of them is not checked.
    """

    active: ActiveRules
    packs: tuple[str, ...]
    depth: Depth
    suppressions: InStages
    is_alone: bool = False
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

    They are plain tuples: a named tuple is pickled by a call of Python's, which takes three times
    as long.
    """

    plain: list[tuple[Any, ...]]

    @classmethod
    def of(cls, findings: Iterable[Finding]) -> NewFindings:
        return cls(list(map(_plain, findings)))

    @property
    def findings(self) -> Iterator[Finding]:
        return map(_named, self.plain)


class Done(NamedTuple):
    """The report on a stage, the last message about it: its findings were sent before.

    `order` are the numbers of those that the report has, in its order, among all that were sent,
    or findings that were not.
    """

    report: StageReport
    order: tuple[int | Finding, ...]

    def with_findings(self, sent: Sequence[Finding]) -> StageReport:
        """The whole report."""
        found = (sent[each] if isinstance(each, int) else each for each in self.order)
        return self.report._replace(findings=tuple(found))


class GivenUp(NamedTuple):
    """The report on a stage that USD would have been busy with for ever, and the last message."""

    report: StageReport


class Advance(NamedTuple):
    """Samples of a long sequence read since the last such message; more messages follow."""

    samples: int


def _plain(finding: Finding) -> tuple[Any, ...]:
    site = finding.site
    excerpt = site.excerpt and tuple(site.excerpt)
    parts = (*site[:_EXCERPT], excerpt, site.entry), tuple(finding.source), tuple(finding.cover)
    return (*finding[:_PARTS], *parts, *finding[_PARTS + len(parts) :])


def _named(plain: tuple[Any, ...]) -> Finding:
    code, name, severity, message, place, source, cover, *rest = plain
    *where, excerpt, entry = place
    site = Site._make((*where, excerpt and Excerpt(*excerpt), entry))
    return Finding(code, name, severity, message, site, Source(*source), Cover(*cover), *rest)
