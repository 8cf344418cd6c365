"""What a run exits with, by what it came to."""

from __future__ import annotations

import signal
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from usdvol_lint.config import Config
    from usdvol_lint.results import Report

CLEAN, FINDINGS, FAILED = 0, 1, 2
_SIGNALLED = 128


def ended_by(number: int) -> int:
    """What a run exits with that a signal ended, as a shell tells of one."""
    return _SIGNALLED + number


def signal_of(error: BaseException) -> int:
    """The number of the signal that raised a KeyboardInterrupt, or of which click made an Abort."""
    said = (error.__cause__ or error).args
    return said[0] if said and isinstance(said[0], int) else int(signal.SIGINT)


def exit_code(report: Report, config: Config, fail_on_unpruned: bool = False) -> int:
    """What a run exits with: from `fail-on` on a cause fails it, and what `config` says besides."""
    from usdvol_lint.model import Severity
    from usdvol_lint.packs.catalog import NOT_IGNORABLE

    if any(cause.code in NOT_IGNORABLE for cause in report.causes):
        return FAILED
    if fail_on_unpruned and report.baseline and report.baseline.is_unpruned:
        return FINDINGS
    if config.fail_on_unchecked and any(cause.is_unchecked for cause in report.causes):
        return FINDINGS
    if config.fail_on == "never":
        return CLEAN
    threshold = Severity[config.fail_on.upper()]
    counted = (cause.severity for cause in report.causes if cause.state.counts)
    return FINDINGS if any(severity >= threshold for severity in counted) else CLEAN
