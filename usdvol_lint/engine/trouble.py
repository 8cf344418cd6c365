"""What stands in a report for a stage that could not be checked, or not to its end."""

from __future__ import annotations

from collections.abc import Iterable

from usdvol_lint.model import Finding, Severity, Site, StageReport, Status, with_fingerprints
from usdvol_lint.packs.catalog import STAGE_UNREADABLE, help_for
from usdvol_lint.paths import display


class Unreadable(Exception):  # noqa: N818  (it says what a path is, like a status)
    """Why a path is not a stage; the place is where text does not parse."""

    def __init__(
        self,
        message: str,
        suggestion: str | None = None,
        layer: str | None = None,
        line: int | None = None,
        column: int | None = None,
        detail: str | None = None,
    ) -> None:
        super().__init__(message)
        self.message = message
        self.suggestion = suggestion
        self.layer = layer
        self.line = line
        self.column = column
        self.detail = detail


def report_trouble(
    path: str,
    trouble: Unreadable,
    status: Status = Status.UNREADABLE,
    seconds: dict[str, float] | None = None,
    found: Iterable[Finding] = (),
) -> StageReport:
    """A stage's report that holds one LNT001 finding, and what was found before."""
    finding = Finding(
        code=STAGE_UNREADABLE.code,
        name=STAGE_UNREADABLE.name,
        severity=Severity.ERROR,
        message=trouble.message,
        site=Site(display(trouble.layer or path), line=trouble.line, column=trouble.column),
        suggestion=trouble.suggestion,
        help=help_for(STAGE_UNREADABLE),
        detail=trouble.detail,
    )
    return StageReport(
        display(path), status, {}, with_fingerprints([finding, *found]), seconds or {}
    )
