"""The report for pages of code hosts, such as a comment or the summary of a step: Markdown.

Foreign text stands in code spans alone, where it is neither markup nor a link nor a mention.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from usdvol_lint.model import Finding, Severity, Status
from usdvol_lint.report import Options, Writer
from usdvol_lint.report.limits import Room, cut
from usdvol_lint.report.numbers import count
from usdvol_lint.report.stagewise import is_undone
from usdvol_lint.report.telling import Told, elsewhere, message, remarks, told
from usdvol_lint.report.text import location, shortened, where
from usdvol_lint.report.verdict import unpruned, verdict
from usdvol_lint.results import Report
from usdvol_lint.words import printable

_MOST_BYTES = 60_000
"""GitHub takes comments of 65,536 characters."""
_FOR_WHAT_IS_LEFT_OUT = 400
_LONGEST_TEXT = 1_000

_TABLE = "\n| rule | name | level | causes | places |\n|---|---|---|--:|--:|\n"
_LINK = re.compile(r"https?://[A-Za-z0-9.-]+(:[0-9]+)?(/[A-Za-z0-9._~%/#?=&+-]*)?")


class Markdown(Writer):
    """As much as a comment may have."""

    def end(self, report: Report) -> Iterator[str]:
        yield markdown(report, self.options, _MOST_BYTES)


def markdown(report: Report, options: Options, most: int) -> str:
    """The report in at most so many bytes of UTF-8: the worst first, and how much is left out.

    Where there is no room for the verdict, it is empty.
    """
    options = _with_what_fails(options)
    heading = _heading(report, options)
    room = Room(most)
    if not room.takes(heading):
        return ""
    room.left -= _FOR_WHAT_IS_LEFT_OUT
    if room.left < 0:
        return heading
    return heading + "".join(_blocks(report, options, room))


def _with_what_fails(options: Options) -> Options:
    """The options with which all that fails the run is told."""
    least = min(options.least, options.fail_on or options.least)
    return options._replace(least=least)


def _blocks(report: Report, options: Options, room: Room) -> Iterator[str]:
    telling = sorted(
        (one for lines in told(report, options).values() for one in lines), key=_worst_first
    )
    unchecked = [stage for stage in report.stages if stage.status is not Status.CHECKED]
    rules = _rules(telling)
    if report.failure and room.takes(failure := f"\n{code(report.failure)}\n"):
        yield failure
    yield from _fitting(
        "stage",
        "\nNot checked:\n\n",
        [(f"- {code(stage.path)} ({stage.status.replace('_', ' ')})\n", 1) for stage in unchecked],
        len(unchecked),
        room,
    )
    rows = [(_row(rule), 1) for rule in rules]
    half = Room(room.left // 2)
    yield from _fitting("rule", _TABLE, rows, len(rows), half)
    room.left -= room.left // 2 - half.left
    entries = ((_entry(one, report, options), len(one.causes)) for one in telling)
    yield from _fitting("cause", "\n", entries, sum(len(one.causes) for one in telling), room)


def _worst_first(one: Told) -> tuple[bool, bool, int]:
    return not is_undone(one.first), not one.first.state.counts, -one.first.severity


def _fitting(
    noun: str, before: str, items: Iterable[tuple[str, int]], number: int, room: Room
) -> Iterator[str]:
    """The first of the items, as far as there is room; each has a text and what it counts for."""
    left = number
    if left and room.takes(before):
        yield before
        for text, counting in items:
            if not room.takes(text):
                break
            yield text
            left -= counting
    if left:
        yield f"\n… and {count(left, noun)} more, for which there is no room here\n"


# --- the verdict ----------------------------------------------------------------------------------


def _heading(report: Report, options: Options) -> str:
    if report.failure:
        return "## usdvol-lint could not do its job\n"
    said = verdict(report, options)
    if report.baseline and report.baseline.written:
        said = code(said)  # which names a file
    return f"## usdvol-lint {'failed' if _fails(report, options) else 'passed'}: {said}\n"


def _fails(report: Report, options: Options) -> bool:
    unchecked = any(stage.status is not Status.CHECKED for stage in report.stages)
    if unchecked or unpruned(report, options):
        return True
    return any(options.fails(cause) or is_undone(cause) for cause in report.causes)


# --- by rule --------------------------------------------------------------------------------------


class _Rule(NamedTuple):
    """How much is told of one rule, and how bad the worst of it is."""

    first: Finding
    level: Severity
    causes: int
    places: int


def _rules(telling: Sequence[Told]) -> list[_Rule]:
    """The rules whose causes count, the worst first."""
    found: dict[str, _Rule] = {}
    for cause in (cause for one in telling for cause in one.causes if cause.state.counts):
        level, places = cause.severity, cause.count
        if rule := found.get(cause.code):
            level = max(level, rule.level)
            found[cause.code] = _Rule(rule.first, level, rule.causes + 1, rule.places + places)
        else:
            found[cause.code] = _Rule(cause.first, level, 1, places)
    return sorted(found.values(), key=lambda rule: (-rule.level, -rule.causes, rule.first.code))


def _row(rule: _Rule) -> str:
    first = rule.first
    name = code(first.name, in_table=True)
    if first.help and _LINK.fullmatch(first.help):
        name = f"[{name}]({first.help})"
    cells = (code(first.code, in_table=True), name, rule.level.label)
    return f"| {' | '.join(cells)} | {rule.causes:,} | {rule.places:,} |\n"


# --- one cause ------------------------------------------------------------------------------------


def _entry(one: Told, report: Report, options: Options) -> str:
    """What is told at once, as an item of a list with a line for each thing that is said."""
    return "- " + "\\\n  ".join(_lines(one, report, options)) + "\n"


def _lines(one: Told, report: Report, options: Options) -> Iterator[str]:
    yield " ".join(_place(one))
    yield code(message(one, options.verbose))
    if others := elsewhere(one, report, options.verbose):
        yield f"also {code(others)}"
    for label, said in remarks(one):
        yield f"{label} {code(said)}"
    if suggestion := one.finding.suggestion:
        yield f"help: {code(suggestion if options.verbose else shortened(suggestion))}"


def _place(one: Told) -> Iterator[str]:
    cause, site = one.first, one.finding.site
    yield f"**{cause.severity.label}** {code(one.finding.code)}"
    if not cause.state.counts:
        yield f"({cause.state})"
    if cause.source.layer is not None:
        yield f"in {code(location(site))}"
    prim = [f"<{site.prim}>"] if site.prim else []
    if place := ", ".join((*prim, *where(site))):
        yield f"at {code(place)}"


def code(text: str, in_table: bool = False) -> str:
    """Foreign text as a code span, in which nothing has a meaning but its end; on one line."""
    text = cut(printable(text), _LONGEST_TEXT)
    if in_table:
        text = text.replace("|", r"\x7c")  # which would end the cell, also in a code span
    runs = [len(run) for run in re.findall("`+", text)]
    fence = "`" * (max(runs, default=0) + 1)
    if not text.strip(" ") or text[0] in "` " or text[-1] in "` ":
        text = f" {text} "  # a space on either side is taken off
    return f"{fence}{text}{fence}"
