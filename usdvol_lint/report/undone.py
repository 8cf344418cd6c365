"""Says why a run did not do its job: a report without findings is then not a clean one."""

from __future__ import annotations

from collections.abc import Iterator

from usdvol_lint.model import Status
from usdvol_lint.report.numbers import count, few
from usdvol_lint.results import Report
from usdvol_lint.words import printable


def undone(report: Report) -> Iterator[str]:
    """What the run did not do, each in a sentence without a full stop; nothing if it did it all."""
    if report.failure:
        yield printable(report.failure)
    unchecked = [
        printable(stage.path) for stage in report.stages if stage.status is not Status.CHECKED
    ]
    if unchecked:
        stages = count(len(report.stages), "stage")
        yield f"{len(unchecked):,} of {stages} could not be checked: {few(unchecked)}"
    elif codes := _codes_of_failures(report):
        yield f"not everything could be checked ({', '.join(codes)})"


def _codes_of_failures(report: Report) -> list[str]:
    from usdvol_lint.packs.catalog import NOT_IGNORABLE

    return sorted(NOT_IGNORABLE & {cause.code for cause in report.causes})
