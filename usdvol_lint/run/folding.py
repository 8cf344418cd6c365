"""Folds the reports on stages into causes, without what other stages of the run complete."""

from __future__ import annotations

from collections.abc import Iterable

from usdvol_lint.model import Finding, StageReport
from usdvol_lint.results import Cause, StageResult
from usdvol_lint.run.causes import Causes
from usdvol_lint.run.parts import completed_by


def folded(
    causes: Causes, judged: Iterable[tuple[StageReport, bool]], are_declared: bool
) -> tuple[tuple[StageResult, ...], tuple[Cause, ...]]:
    """The stages and the causes; of the findings only those are kept that may be completed.

    Where wholes and parts are declared, nothing completes a whole, and a part lacks nothing.
    """
    kept: list[tuple[StageReport, bool]] = []
    waiting: list[tuple[int, int, Finding]] = []
    for stage, (report, is_part) in enumerate(judged):
        numbered = list(enumerate(report.findings))
        causes.add(stage, report.path, (pair for pair in numbered if not pair[1].absent))
        absent = [(stage, *pair) for pair in numbered if pair[1].absent and not is_part]
        waiting += absent
        lacking = tuple(finding for *_, finding in absent)
        kept.append((report._replace(findings=lacking), is_part))
    is_completed = completed_by([report for report, _ in kept]) if not are_declared else None
    for stage, number, finding in waiting:
        report, _ = kept[stage]
        if is_completed is None or not is_completed(report, finding):
            causes.add(stage, report.path, [(number, finding)])
    found, numbers = causes.result()
    stages = (
        causes.stage(number, report, numbers, is_part)
        for number, (report, is_part) in enumerate(kept)
    )
    return tuple(stages), found
