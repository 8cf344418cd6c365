"""Report formats: each is a module with `render(report, options)`, imported when asked for."""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from typing import TYPE_CHECKING, Final, NamedTuple

if TYPE_CHECKING:
    from usdvol_lint.model import Report

FORMATS: Final[Mapping[str, str]] = {
    "full": "usdvol_lint.report.text",
    "concise": "usdvol_lint.report.concise",
    "json": "usdvol_lint.report.json_report",
}
"""The name of each format, and the module that writes it."""


class Options(NamedTuple):
    """How to write a report; a format ignores what means nothing to it.

    `width` is that of the terminal and matters with `color` only.
    """

    color: bool = False
    width: int = 80
    quiet: bool = False
    verbose: bool = False


def render(report: Report, format: str, options: Options) -> str:
    """The whole report in one of FORMATS: empty, or ending in a newline."""
    text: str = import_module(FORMATS[format]).render(report, options)
    return text
