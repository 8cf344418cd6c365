"""The report for GitLab's Code Quality: a list with an entry for each cause."""

from __future__ import annotations

import json
import posixpath
import re
from collections.abc import Iterator
from functools import cache, partial

from usdvol_lint.model import Severity
from usdvol_lint.paths import below, canonical
from usdvol_lint.report import Options, Writer
from usdvol_lint.report.addresses import Address, addresses
from usdvol_lint.report.sentences import sentences
from usdvol_lint.report.undone import undone
from usdvol_lint.results import Report
from usdvol_lint.words import printable, without_commands

SEVERITIES = {Severity.ERROR: "major", Severity.WARNING: "minor", Severity.INFO: "info"}
UNDONE = "usdvol-lint"
"""The check of an entry that is no cause: the run did not do its job."""

# All that is not ASCII is escaped, so that no terminal obeys it.
_ENCODE = json.JSONEncoder(allow_nan=False).encode

_HALF = re.compile("[\ud800-\udfff]")


class GitLab(Writer):
    """A list; an entry names the stage where the layer lies elsewhere, so all stages are needed."""

    def end(self, report: Report) -> Iterator[str]:
        before = "[\n"
        for entry in _entries(report, self.options):
            yield f"{before}  {_line(entry)}"
            before = ",\n"
        yield "[]\n" if before == "[\n" else "\n]\n"


def _entries(report: Report, options: Options) -> Iterator[dict[str, object]]:
    address_of = addresses(report, options.repository)
    path_of = cache(partial(_path, repository=options.repository))
    is_empty = True
    for cause in report.causes:
        if cause.state.counts:
            is_empty = False
            address = address_of(cause)
            yield {
                "description": sentences(cause, address),
                "check_name": printable(cause.code) or UNDONE,
                "fingerprint": cause.fingerprint,
                "severity": SEVERITIES[cause.severity],
                "location": _location(path_of(address.file), address.line),
            }
    # An empty list is a clean one to GitLab.
    if report.failure or is_empty:
        yield from _undone(report, options.repository)


def _undone(report: Report, repository: str | None) -> Iterator[dict[str, object]]:
    """An entry on a run that did not do its job; none on one that did."""
    reasons = "; ".join(undone(report))
    if reasons:
        yield {
            "description": reasons,
            "check_name": UNDONE,
            "fingerprint": UNDONE,
            "severity": "blocker",
            "location": _location(_path(_first_argument(report, repository), repository), None),
        }


def _first_argument(report: Report, repository: str | None) -> str:
    """What the run was asked to check, or the first of it: a place that is there."""
    argument = posixpath.join(report.root or "", *report.arguments[:1])
    return below(canonical(argument), repository) if repository else argument


def _location(path: str, line: int | None) -> dict[str, object]:
    return {"path": path, "lines": {"begin": line or 1}}


def _path(file: str, repository: str | None) -> str:
    """A file in relation to the repository, also where it lies outside."""
    if Address(file).is_absolute:
        file = posixpath.relpath(file, repository or "/")
    return printable(file) if _HALF.search(file) else file or "."


def _line(value: object) -> str:
    return without_commands(_ENCODE(value))
