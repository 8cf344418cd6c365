"""The LNT001 report of a stage that was not, or only partly, checked."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from usdvol_lint.model import Cover, Finding, Severity, Site, Source, StageReport, Status, in_order
from usdvol_lint.packs.catalog import STAGE_UNREADABLE, help_for
from usdvol_lint.paths import canonical, display_beside, named

PACK_FAILURES = (Exception, KeyboardInterrupt)
"""What the code of a rule pack may raise without ending the process."""


class Trouble(NamedTuple):
    """Why a stage was not checked; `layer`, `line` and `column` are where text does not parse.

    `layer` is None if that is the stage's root layer, `detail` is what `--verbose` adds.
    `of_machine` names what of the machine is to blame, where it is not the stage.
    """

    message: str
    suggestion: str | None = None
    layer: str | None = None
    line: int | None = None
    column: int | None = None
    detail: str | None = None
    of_machine: str | None = None


class UnreadableStageError(Exception):
    """A path that can't be opened as a stage."""

    def __init__(self, trouble: Trouble) -> None:
        super().__init__(trouble.message)
        self.trouble = trouble


def report_trouble(
    path: str,
    trouble: Trouble,
    status: Status = Status.UNREADABLE,
    seconds: dict[str, float] | None = None,
    found: Iterable[Finding] = (),
) -> StageReport:
    """A stage's report: one LNT001 finding, and those `found` before the trouble."""
    layer = None if trouble.of_machine else canonical(trouble.layer or path)
    finding = Finding(
        code=STAGE_UNREADABLE.code,
        name=STAGE_UNREADABLE.name,
        severity=Severity.ERROR,
        message=trouble.message,
        site=Site(
            display_beside(path, trouble.layer or path), line=trouble.line, column=trouble.column
        ),
        source=Source(layer, subject=trouble.of_machine or ""),
        cover=Cover(Severity.ERROR),
        suggestion=trouble.suggestion,
        help=help_for(STAGE_UNREADABLE),
        detail=trouble.detail,
    )
    return StageReport(named(path), status, {}, in_order([finding, *found]), seconds or {})
