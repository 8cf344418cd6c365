"""The report as GitHub's annotations: workflow commands, of which it shows few."""

from __future__ import annotations

from collections.abc import Iterator

from usdvol_lint.model import Severity
from usdvol_lint.report import Writer
from usdvol_lint.report.addresses import Address, addresses
from usdvol_lint.report.numbers import count, counts
from usdvol_lint.report.sentences import statements
from usdvol_lint.report.undone import undone
from usdvol_lint.report.verdict import unpruned
from usdvol_lint.results import Cause, Report
from usdvol_lint.words import printable

MOST = 10
"""How many errors, and how many warnings, GitHub shows of one step: it drops the rest."""


_KINDS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "notice"}


class GitHub(Writer):
    """The worst causes first, each once; then how many there are."""

    def end(self, report: Report) -> Iterator[str]:
        found = list(filter(None, (*undone(report), unpruned(report, self.options))))
        yield from (_command("error", {"title": "usdvol-lint"}, what) for what in found)
        address = addresses(report, self.options.repository)
        left_out = []
        for level in reversed(Severity):
            causes = [each for each in report.causes if self._is_told(each, level)]
            room = MOST - len(found) if level is Severity.ERROR else MOST
            yield from (_annotation(each, address(each)) for each in causes[:room])
            left_out.append((len(causes[room:]), level.label))
        if more := counts(*left_out):
            yield _command("notice", {"title": "usdvol-lint"}, _summary(report, more))

    def _is_told(self, cause: Cause, level: Severity) -> bool:
        """Whether a cause of this level is told: infos only where they fail the run."""
        if not cause.state.counts or cause.severity is not level:
            return False
        return level > Severity.INFO or self.options.fails(cause)


def _annotation(cause: Cause, address: Address) -> str:
    finding = cause.first
    properties = {"file": address.file, "title": f"{finding.code} {finding.name}"}
    if address.line is not None:
        properties["line"] = str(address.line)
        if address.column is not None:
            properties["col"] = str(address.column)
    return _command(_KINDS[cause.severity], properties, "\n".join(statements(cause, address)))


def _summary(report: Report, more: str) -> str:
    summary = report.summary
    found = counts(
        (summary.errors, "error"), (summary.warnings, "warning"), (summary.infos, "info")
    )
    where = count(summary.stages, "stage")
    return f"{found} in {where}: {more} more than GitHub shows here are in the log"


def _command(name: str, properties: dict[str, str], message: str) -> str:
    said = ",".join(f"{key}={_property(value)}" for key, value in properties.items())
    return f"::{name} {said}::{_data(message)}\n"


def _data(text: str) -> str:
    """Text as a workflow command has it: in one line, and without anything a terminal obeys."""
    lines = map(printable, text.replace("%", "%25").split("\n"))
    return "%0A".join(lines)


def _property(text: str) -> str:
    return _data(text).replace(":", "%3A").replace(",", "%2C")
