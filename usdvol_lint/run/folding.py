"""Folds the reports on stages into causes, without what other stages of the run complete."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from usdvol_lint.model import Finding, StageReport
from usdvol_lint.results import Cause, StageResult
from usdvol_lint.run.causes import Causes
from usdvol_lint.run.parts import completed_by
from usdvol_lint.run.teller import Silent, Teller


def folded(
    causes: Causes,
    judged: Iterable[tuple[StageReport, bool]],
    are_declared: bool,
    teller: Teller | None = None,
) -> tuple[tuple[StageResult, ...], tuple[Cause, ...]]:
    """The stages and the causes, each told as soon as it is known that it is one.

    Of a report nothing is kept but what may be completed, or complete, and the first places of
    causes.  What is absent is told last, for any stage of the run may complete it; where wholes and
    parts are declared, nothing completes a whole, and a part lacks nothing.
    """
    told = Silent() if teller is None else teller
    stages: list[StageResult] = []
    lacking: dict[int, StageReport] = {}
    kept: list[StageReport] = []
    for stage, (report, is_part) in enumerate(judged):
        waits = is_part or not are_declared
        absent = tuple(each for each in report.findings if each.absent) if waits else ()
        causes.add(stage, report.path, _present(report.findings) if absent else report.findings)
        if report.findings:
            report = report._replace(findings=() if is_part else absent)
        if report.findings:
            lacking[stage] = report
        if report.findings or report.completes:
            kept.append(report)
        stages.append(causes.stage(stage, report, is_part, waits=bool(report.findings)))
        causes.tell(told)
        told.stage(stage, stages[-1])
    is_completed = completed_by(kept if lacking else ())
    for stage, report in lacking.items():
        left = (each for each in report.findings if not is_completed(report, each))
        causes.add(stage, report.path, left)
    found = causes.result()
    causes.tell(told)
    return causes.completed(stages), found


def _present(findings: Iterable[Finding]) -> Iterator[Finding]:
    return (finding for finding in findings if not finding.absent)
