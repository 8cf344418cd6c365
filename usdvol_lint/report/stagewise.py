"""What each stage shows, and how a cause looks there: each is told as often as it is shown."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cache
from typing import NamedTuple, TypeAlias

from usdvol_lint.model import Finding, Severity
from usdvol_lint.packs.catalog import NOT_IGNORABLE
from usdvol_lint.report import Options
from usdvol_lint.report.limits import cut
from usdvol_lint.report.numbers import few
from usdvol_lint.report.telling import Told as AtOnce
from usdvol_lint.report.telling import remarks
from usdvol_lint.report.text import location, where
from usdvol_lint.results import Cause, Report, StageResult
from usdvol_lint.words import printable

Told: TypeAlias = tuple[int, Severity]
"""The number of a cause, and how bad it is on the stage."""


class Some(NamedTuple):
    """Some of what a stage shows: how many causes of which level, and these, when looked at."""

    levels: Mapping[Severity, int]
    told: Iterable[Told]

    @property
    def number(self) -> int:
        return sum(self.levels.values())


class Shown(NamedTuple):
    """What a stage shows, each part with the worst first.

    What is `undone` says that the job was not done, what is `failing` is what `--fail-on` counts;
    `below` is all that counts beside, `uncounted` what is known or suppressed where that is shown.
    """

    undone: Sequence[Told]
    failing: Some
    below: Some
    uncounted: Sequence[Told]


def is_undone(cause: Cause) -> bool:
    """Whether it says that the job was not done, so that the run fails whatever its level."""
    return cause.code in NOT_IGNORABLE


class Stagewise:
    """What stages show: as many as causes times stages, so little is done with each."""

    def __init__(self, report: Report, options: Options) -> None:
        self._report = report
        self._least = options.fail_on or max(Severity) + 1
        undone = [is_undone(cause) or options.fails_unchecked(cause) for cause in report.causes]
        self._counting = [
            cause.state.counts and not apart
            for cause, apart in zip(report.causes, undone, strict=True)
        ]
        self._undone = {number for number, apart in enumerate(undone) if apart}
        self._uncounted = {
            number for number, cause in enumerate(report.causes) if cause.state in options.show
        } - self._undone

    def shown(self, stage: StageResult) -> Shown:
        """What one stage shows."""
        undone = self._told(stage, self._undone)
        uncounted = self._told(stage, self._uncounted)
        numbers = dict(stage.levels)
        for number, level in undone:
            if self._report.causes[number].state.counts:
                numbers[level] -= 1
        failing = {level: n for level, n in numbers.items() if n and level >= self._least}
        below = {level: n for level, n in numbers.items() if n and level < self._least}
        return Shown(
            undone,
            Some(failing, self._counted(stage, failing)),
            Some(below, self._counted(stage, below)),
            uncounted,
        )

    def _told(self, stage: StageResult, wanted: set[int]) -> list[Told]:
        if not wanted:
            return []
        found = (
            (number, level or self._report.causes[number].severity)
            for number, level in zip(stage.causes, stage.worst, strict=True)
            if number in wanted
        )
        return sorted(found, key=lambda told: -told[1])

    def _counted(self, stage: StageResult, levels: Iterable[Severity]) -> Iterator[Told]:
        for wanted in sorted(levels, reverse=True):
            for number, level in zip(stage.causes, stage.worst, strict=True):
                if level is wanted and self._counting[number]:
                    yield number, level


# --- in words -------------------------------------------------------------------------------------


class Looks:
    """How causes look on stages, in a few lines each."""

    def __init__(self, report: Report) -> None:
        self._report = report
        self._on = cache(self._findings_by_stage)
        self._elsewhere = cache(self._as_elsewhere)

    def on(self, stage: int, number: int, level: Severity) -> str:
        """A cause as that stage shows it, or, where it does not carry that, as the first does."""
        findings = self._on(number).get(stage)
        if not findings:
            return self._elsewhere(number, level)
        cause = self._report.causes[number]
        lines = _lines(cause, findings[0], level)
        return "\n".join((*lines, *_others(findings, cause, cause.places[-1].stage == stage)))

    def _findings_by_stage(self, number: int) -> dict[int, list[Finding]]:
        found: dict[int, list[Finding]] = {}
        for stage, finding in self._report.causes[number].places:
            found.setdefault(stage, []).append(finding)
        return found

    def _as_elsewhere(self, number: int, level: Severity) -> str:
        cause = self._report.causes[number]
        stage = self._report.stages[cause.places[0].stage]
        shown = cut(f"  as {printable(stage.path)} shows it")
        return "\n".join((*_lines(cause, cause.first, level), shown))


def _lines(cause: Cause, finding: Finding, level: Severity) -> Iterator[str]:
    state = "" if cause.state.counts else f" ({cause.state})"
    yield cut(f"{printable(finding.code)} {level.label}{state}: {printable(finding.message)}")
    if cause.source.layer is not None:
        yield cut(f"  --> {location(finding.site)}")
    prim = [f"<{printable(finding.site.prim)}>"] if finding.site.prim else []
    if place := ", ".join((*prim, *where(finding.site))):
        yield cut(f"  at {place}")
    for label, said in remarks(AtOnce((cause,), 0, ())):
        yield cut(f"  {label} {said}")
    if finding.suggestion:
        yield cut(f"  help: {printable(finding.suggestion)}")


def _others(findings: Sequence[Finding], cause: Cause, is_last: bool) -> Iterator[str]:
    """Where else on the stage it shows; the last stage may have more places than are carried."""
    told = findings[0].site.prim
    prims = dict.fromkeys(each.site.prim for each in findings if each.site.prim != told)
    names = [f"<{printable(prim)}>" for prim in prims if prim]
    if is_last and cause.count > len(cause.places):
        names.append("others")
    if names:
        yield cut(f"  also at {few(names)}")
