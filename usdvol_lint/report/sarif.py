"""The report for code scanning: SARIF 2.1.0, one run, the worst causes first."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator, Sequence
from functools import cache, partial
from operator import attrgetter
from urllib.parse import quote

from usdvol_lint.model import Site
from usdvol_lint.report import Options, Writer
from usdvol_lint.report.addresses import Address, addresses, stage_addresses
from usdvol_lint.report.numbers import count
from usdvol_lint.report.sarif_rules import LEVELS, described
from usdvol_lint.report.sentences import object_path, sentences
from usdvol_lint.report.undone import undone
from usdvol_lint.results import Cause, Place, Report
from usdvol_lint.words import printable, without_commands

SCHEMA = "https://json.schemastore.org/sarif-2.1.0.json"
MOST_RESULTS = 5000
"""As many as GitHub keeps of a run; it does not choose the worst ones."""
MOST_PLACES = 50
"""GitHub takes 1,000 locations a result, and 10 MB a file."""

# All that is not ASCII is escaped: no terminal obeys it, and what halves of characters there are
# can be told from bytes that can't be decoded.
_SIGNALLED = 128
"""What a run that a signal ended exits with, without the number of the signal."""
_ENCODE = json.JSONEncoder(allow_nan=False).encode

_DRIVE = re.compile(r"[A-Za-z]:(?=/)")


class Sarif(Writer):
    """One object; which causes are the worst only the whole report tells."""

    def end(self, report: Report) -> Iterator[str]:
        counted = [cause for cause in report.causes if cause.state.counts]
        chosen = sorted(counted, key=attrgetter("severity"), reverse=True)[:MOST_RESULTS]
        yield f'{{\n  "$schema": {_line(SCHEMA)},\n  "version": "2.1.0",\n  "runs": [{{\n'
        for key, value in _run(report, len(counted), self.options).items():
            yield f"    {_line(key)}: {_line(value)},\n"
        rules = described(chosen, report, self.options.page_of)
        yield f'    "tool": {{"driver": {{\n      {_line(_tool(report))[1:-1]},\n      "rules": '
        yield from _list(map(_line, rules.values()), "      ")
        yield '\n    }},\n    "results": '
        yield from _list(_results(chosen, list(rules), report, self.options), "    ")
        yield "\n  }]\n}\n"


def _list(lines: Iterator[str], indent: str) -> Iterator[str]:
    """A list with a line for each item."""
    before = "[\n"
    for line in lines:
        yield f"{before}{indent}  {line}"
        before = ",\n"
    yield "[]" if before == "[\n" else f"\n{indent}]"


def _tool(report: Report) -> dict[str, object]:
    version = printable(report.version)
    return {"name": "usdvol-lint", "version": version, "semanticVersion": version}


def _run(report: Report, causes: int, options: Options) -> dict[str, object]:
    """What stands before tool and results; `causes` are all that count."""
    run: dict[str, object] = {
        "automationDetails": {"id": _automation_id(options.category)},
        "columnKind": "unicodeCodePoints",
        "invocations": [_invocation(report, causes)],
    }
    if causes > MOST_RESULTS:
        run["properties"] = {"findings": causes, "findingsInThisFile": MOST_RESULTS}
    return run


def _automation_id(category: str) -> str:
    """What is before the last slash is the category by which GitHub replaces an upload."""
    name = printable(category).strip("/")
    return f"usdvol-lint/{name}/" if name else "usdvol-lint/"


def _invocation(report: Report, causes: int) -> dict[str, object]:
    failures = list(undone(report))
    invocation: dict[str, object] = {"executionSuccessful": not failures}
    notifications = [_notification("error", text) for text in failures]
    if failures:
        invocation["exitCode"] = _SIGNALLED + report.interrupted if report.interrupted else 2
    if causes > MOST_RESULTS:
        text = f"these are the worst {MOST_RESULTS:,} of {count(causes, 'finding')}"
        hint = "ignore rules, check fewer stages, or write a baseline to see the others"
        notifications.append(_notification("warning", f"{text}: {hint}"))
    if notifications:
        invocation["toolExecutionNotifications"] = notifications
    return invocation


def _notification(level: str, text: str) -> dict[str, object]:
    return {"level": level, "message": {"text": text}}


# --- results --------------------------------------------------------------------------------------


def _results(
    causes: Sequence[Cause], codes: Sequence[str], report: Report, options: Options
) -> Iterator[str]:
    address_of = addresses(report, options.repository)
    stage_of = stage_addresses(report, options.repository)
    number_of = {code: number for number, code in enumerate(codes)}
    locate = partial(_location, cache(uri))
    for cause in causes:
        address = address_of(cause)
        result = {
            "ruleId": printable(cause.code),
            "ruleIndex": number_of[cause.code],
            "level": LEVELS[cause.severity],
            "message": {"text": sentences(cause, address).replace("](", "] (")},  # else a link
            "locations": [locate(address, cause.first.site)],
            "partialFingerprints": {"primaryLocationLineHash": cause.fingerprint},
            "occurrenceCount": cause.count,
        }
        if others := cause.places[1:MOST_PLACES]:
            result["relatedLocations"] = [
                _related(number, place, report, locate(stage_of(place), place.finding.site))
                for number, place in enumerate(others)
            ]
        yield _line(result)


def _location(uri_of: Callable[[str], str], address: Address, site: Site) -> dict[str, object]:
    physical = {"artifactLocation": {"uri": uri_of(address.file)}, "region": _region(address, site)}
    location: dict[str, object] = {"physicalLocation": physical}
    if path := object_path(site):
        kind = "property" if site.property else "prim"
        location["logicalLocations"] = [{"fullyQualifiedName": printable(path), "kind": kind}]
    return location


def _region(address: Address, site: Site) -> dict[str, object]:
    """From the place on to the end of its line, with its text where that is known."""
    region: dict[str, object] = {"startLine": address.line or 1}
    if address.line and address.column:
        region["startColumn"] = address.column
    if site.excerpt and (site.line, site.column) == (address.line, address.column):
        text, column = site.excerpt
        region["snippet"] = {"text": printable(text[column - 1 :])}
    return region


def _related(
    number: int, place: Place, report: Report, location: dict[str, object]
) -> dict[str, object]:
    """Another place of a cause: the stage that shows it, and the prim there."""
    path = object_path(place.finding.site)
    stage = printable(report.stages[place.stage].path)
    text = f"also at <{printable(path)}> of {stage}" if path else f"also in {stage}"
    return {"id": number, "message": {"text": text}, **location}


def uri(file: str) -> str:
    """A reference to a file in relation to the repository, or the URI of an absolute path."""
    drive = _DRIVE.match(file)
    if drive and Address(file).is_absolute:
        return f"file:///{drive.group()}{_quoted(file[drive.end() :])}"
    if file.startswith("//"):
        return f"file:{_quoted(file)}"
    if file.startswith("/"):
        return f"file://{_quoted(file)}"
    return _quoted(file or ".")


def _quoted(path: str) -> str:
    try:
        return quote(path, errors="surrogateescape")  # the bytes of a name that is not UTF-8
    except UnicodeEncodeError:
        return quote(path, errors="surrogatepass")


def _line(value: object) -> str:
    return without_commands(_ENCODE(value))
