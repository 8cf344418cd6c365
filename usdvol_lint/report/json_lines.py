"""The report for programs that read line by line: each follows `report-line-2.0.schema.json`.

The lines hold the very objects of the JSON report: `run` comes first and has what stands there
before the causes, `summary` comes last and has what stands there after them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from usdvol_lint.model import Severity
from usdvol_lint.report import Options, Writer
from usdvol_lint.report.json_report import Shared, cause_members, head, line, place_members, rest
from usdvol_lint.results import Cause, Place, Report
from usdvol_lint.words import escaped


class JsonLines(Writer):
    """A line when something is known; what a place says of its own is held against the first."""

    _shared: Shared

    def __init__(self, options: Options) -> None:
        super().__init__(options)
        self._said: dict[int, Cause] = {}

    def begin(self, report: Report) -> Iterator[str]:
        self._shared = Shared.of(report)
        yield _of_type("run", head(report))

    def cause(self, number: int, cause: Cause) -> Iterator[str]:
        self._said[number] = cause
        said = cause_members(cause, cause.places[:1], self._shared)
        yield escaped(f'{{"type": "cause", "number": {number}, {said}}}\n')

    def place(self, number: int, place: Place) -> Iterator[str]:
        said = place_members(place, self._said[number].first, self._shared)
        yield escaped(f'{{"type": "place", "cause": {number}, {said}}}\n')

    def raised(self, number: int, cause: Cause, was: Severity) -> Iterator[str]:
        self._said[number] = self._said[number]._replace(severity=cause.severity)
        yield _of_type("change", {"cause": number, "severity": cause.severity.label})

    def end(self, report: Report) -> Iterator[str]:
        for number, cause in enumerate(report.causes):
            if changed := self._changed(self._said[number], cause):
                yield _of_type("change", {"cause": number, **changed})
        last = rest(report)
        for number, stage in enumerate(last.pop("stages")):
            yield _of_type("stage", {"number": number, **stage})
        yield _of_type("summary", last)

    def _changed(self, said: Cause, cause: Cause) -> dict[str, object]:
        """What was not known yet when a cause was told."""
        changed: dict[str, object] = {}
        if cause.cover != said.cover:
            from usdvol_lint.baseline.cover import cover_as_json

            changed["cover"] = cover_as_json(cause.cover)
        if cause.count != said.count:
            changed["count"] = cause.count
        return changed


def _of_type(name: str, said: Mapping[str, object]) -> str:
    return line({"type": name, **said}) + "\n"
