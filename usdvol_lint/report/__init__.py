"""The output formats: each is a module with `render(report, options)`, imported when used."""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from typing import TYPE_CHECKING, Final, NamedTuple

from usdvol_lint.model import Finding, Severity

if TYPE_CHECKING:
    from usdvol_lint.model import Report

FORMATS: Final[Mapping[str, str]] = {
    "full": "usdvol_lint.report.text",
    "concise": "usdvol_lint.report.concise",
    "json": "usdvol_lint.report.json_report",
}
"""The module that writes each format, by the format's name."""


class Options(NamedTuple):
    """How to write a report; a format may ignore some of it.

    `width` is that of the terminal in cells: with `color`, the text report is wrapped to it.
    Reports for people have findings from the severity `least` on; `verbose` shows all of them.
    """

    color: bool = False
    width: int = 80
    quiet: bool = False
    verbose: bool = False
    least: Severity = Severity.WARNING

    def shows(self, finding: Finding) -> bool:
        """Whether a report for people has this finding."""
        return self.verbose or finding.severity >= self.least


def render(report: Report, format: str, options: Options) -> str:
    """The report in one of FORMATS: empty, or with a newline at its end."""
    text: str = import_module(FORMATS[format]).render(report, options)
    return text
