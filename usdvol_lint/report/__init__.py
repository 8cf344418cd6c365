"""The output formats: each is a module with `render(report, options)`, imported when used."""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from typing import TYPE_CHECKING, Final, NamedTuple

from usdvol_lint.model import Severity

if TYPE_CHECKING:
    from usdvol_lint.results import Cause, Report

FORMATS: Final[Mapping[str, str]] = {
    "full": "usdvol_lint.report.text",
    "concise": "usdvol_lint.report.concise",
    "json": "usdvol_lint.report.json_report",
}
"""The module that writes each format, by the format's name."""


class Options(NamedTuple):
    """How to write a report; a format may ignore some of it.

    `width` is that of the terminal in cells: with `color`, the text report is wrapped to it.
    Reports for people have causes from the severity `least` on; `verbose` shows all of them.
    What is `known` or `suppressed` is there only where `show` names it, and then all of it.
    """

    color: bool = False
    width: int = 80
    quiet: bool = False
    verbose: bool = False
    least: Severity = Severity.WARNING
    show: frozenset[str] = frozenset()

    @property
    def threshold(self) -> Severity:
        """The severity from which on reports for people have a cause."""
        return Severity.INFO if self.verbose else self.least

    def shows(self, cause: Cause) -> bool:
        """Whether a report for people has this cause."""
        if not cause.state.counts:
            return cause.state in self.show
        return cause.severity >= self.threshold


def render(report: Report, format: str, options: Options) -> str:
    """The report in one of FORMATS: empty, or with a newline at its end."""
    text: str = import_module(FORMATS[format]).render(report, options)
    return text
