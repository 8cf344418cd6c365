"""Markdown that says what it means to a parser of Markdown, and keeps to its room."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator

import pytest
from hypothesis import given
from hypothesis import strategies as st
from markdown_it import MarkdownIt
from markdown_it.token import Token
from reports import (
    CLEAN,
    EVERYTHING,
    FAILED,
    INFOS,
    MISSING,
    NOTHING,
    SMOKE,
    TIMED_OUT,
    found,
    report,
)
from sharedcauses import BY_CAUSE, USED
from test_report_laws import ANYTHING, LAW, OPTIONS, REPORTS

from usdvol_lint.model import Severity, Site, StageReport, Status
from usdvol_lint.report import Options, markdown, render
from usdvol_lint.results import Report, State
from usdvol_lint.words import printable

PARSER = MarkdownIt("commonmark").enable("table")

MARKUP = {
    "heading",
    "paragraph",
    "inline",
    "text",
    "code_inline",
    "hardbreak",
    "strong",
    "bullet_list",
    "list_item",
    "table",
    "thead",
    "tbody",
    "tr",
    "th",
    "td",
    "link",
}
OURS = re.compile(r"[A-Za-z0-9 .,:;()…\n-]*")
HOSTILE = (
    "`",
    "a``b",
    "a` b",
    "``` ` ```",
    "a|b\\|c",
    "\\",
    "a\\`",
    "@user #1",
    "[x](y)",
    "<b>&amp;<!--",
    " a ",
    "    code",
    "# x",
    "- x",
    "http://x.org",
    "![i](j)",
    ":boom:",
    "$`x`$",
    "",
)


def tokens(text: str) -> list[Token]:
    return list(_flat(PARSER.parse(text)))


def _flat(parsed: Iterable[Token]) -> Iterator[Token]:
    for token in parsed:
        yield token
        yield from _flat(token.children or ())


def kinds(parsed: Iterable[Token]) -> set[str]:
    return {token.type.removesuffix("_open").removesuffix("_close") for token in parsed}


def codes(text: str) -> list[str]:
    return [token.content for token in tokens(text) if token.type == "code_inline"]


@LAW
@given(REPORTS, OPTIONS)
def test_what_is_foreign_is_code(subject: Report, options: Options) -> None:
    text = render(subject, "markdown", options)
    text.encode("utf-8")
    assert text.replace("\n", "").isprintable()
    parsed = tokens(text)
    assert kinds(parsed) <= MARKUP
    assert all(OURS.fullmatch(token.content) for token in parsed if token.type == "text")


@LAW
@given(ANYTHING, ANYTHING)
def test_code_says_what_it_was_given(one: str, other: str) -> None:
    assert_literal(one, other)


@pytest.mark.parametrize("text", HOSTILE)
def test_code_says_what_is_markup_elsewhere(text: str) -> None:
    assert_literal(text, text)


def assert_literal(one: str, other: str) -> None:
    """Two of them in a line, in an item of a list, in a heading and in a cell."""
    shown = [printable(text) for text in (one, other)]
    both = " and ".join(map(markdown.code, (one, other)))
    for line in (f"a {both}", f"- {both}", f"## x: {both}"):
        assert [text.strip(" ") for text in codes(line)] == [text.strip(" ") for text in shown]
    cells = " | ".join(markdown.code(text, in_table=True) for text in (one, other))
    table = f"| a | b |\n|---|---|\n| {cells} |\n"
    assert [text.strip(" ") for text in codes(table)] == [
        text.replace("|", r"\x7c").strip(" ") for text in shown
    ]
    assert sum(token.type == "td_open" for token in tokens(table)) == 2


@LAW
@given(REPORTS, OPTIONS, st.integers(0, 3000))
def test_there_is_never_more_than_there_is_room_for(
    subject: Report, options: Options, most: int
) -> None:
    text = markdown.markdown(subject, options, most)
    assert len(text.encode("utf-8")) <= most
    assert text == "" or text.startswith("## usdvol-lint ")
    assert kinds(tokens(text)) <= MARKUP


@LAW
@given(REPORTS, OPTIONS)
def test_the_table_counts_as_json_does(subject: Report, options: Options) -> None:
    options = options._replace(least=Severity.INFO)
    text = markdown.markdown(subject, options, 10**9)
    rows = [line for line in text.splitlines() if line.startswith("| `")]
    by_code = json.loads(render(subject, "json", options))["summary"]["by_code"]
    assert sorted(int(row.split(" | ")[-2].replace(",", "")) for row in rows) == sorted(
        by_code.values()
    )


@pytest.mark.parametrize(
    ("subject", "options", "begins"),
    [
        (EVERYTHING, Options(), "failed: 5 errors"),
        (EVERYTHING, Options(fail_on=None), "failed: 5 errors"),
        (report(SMOKE), Options(fail_on=None), "passed: 3 errors"),
        (BY_CAUSE, Options(), "failed: 1 error"),
        (report(SMOKE, AST002={"state": State.KNOWN}), Options(), "failed: 2 errors"),
        (INFOS, Options(fail_on=Severity.INFO), "failed: 1 info"),
        (INFOS, Options(), "passed: no errors or warnings"),
        (report(TIMED_OUT), Options(), "failed: no findings in 1 stage"),
        (FAILED, Options(), "could not do its job\n"),
        (NOTHING, Options(), "passed: no findings in 1 stage"),
    ],
    ids=range(10),
)
def test_the_heading_has_the_verdict(subject: Report, options: Options, begins: str) -> None:
    assert render(subject, "markdown", options).startswith(f"## usdvol-lint {begins}")


def test_one_line_where_nothing_is_to_be_told() -> None:
    known = report(StageReport("a.usda", Status.CHECKED, {}, (MISSING,)), CLEAN)
    known = known.with_causes([cause._replace(state=State.KNOWN) for cause in known.causes])
    for subject in (NOTHING, INFOS, known):
        assert render(subject, "markdown", Options()).count("\n") == 1


def test_the_name_of_a_file_in_the_verdict_is_code() -> None:
    path = "www.example.org/@me/<b>.jsonl"
    text = render(
        NOTHING._replace(baseline=USED._replace(path=path, written=True)), "markdown", Options()
    )
    assert path in codes(text)[0]


@pytest.mark.parametrize(
    ("page", "linked"),
    [
        ("https://example.org/a_b?c=d#e", True),
        ("usdvol-lint --explain AST002", False),
        ("javascript:alert(1)", False),
        ("https://x.org/)[a](b", False),
        ("https://x.org/a|b", False),
        ("https://x.org/\n# a", False),
    ],
)
def test_a_name_is_linked_to_what_is_an_address(page: str, linked: bool) -> None:
    stage = StageReport("a.usda", Status.CHECKED, findings=(MISSING._replace(help=page),))
    links = [
        token.attrs["href"]
        for token in tokens(render(report(stage), "markdown", Options()))
        if token.type == "link_open"
    ]
    assert links == ([page] if linked else [])


def test_what_is_left_out_is_said_and_the_worst_is_not() -> None:
    findings = tuple(
        found(
            f"AST{number % 90:03}",
            "some-name",
            Severity.ERROR if number == 700 else Severity.WARNING,
            f"no file {number}",
            Site("a.usda", f"/P{number}"),
        )
        for number in range(1000)
    )
    subject = report(
        StageReport("a.usda", Status.CHECKED, findings=findings),
        *(StageReport(f"{n}.usda", Status.TIMED_OUT) for n in range(3)),
    )
    text = markdown.markdown(subject, Options(), 6_000)
    entries = [line for line in text.splitlines() if line.startswith("- **")]
    rows = [line for line in text.splitlines() if line.startswith("| `")]
    assert entries[0].startswith("- **error**")
    assert rows[0].startswith("| `AST070` | `some-name` | error |")
    assert f"… and {90 - len(rows)} rules more, for which there is no room here" in text
    assert f"… and {1000 - len(entries)} causes more, for which there is no room here" in text
    assert 5_000 < len(text.encode()) <= 6_000
    tiny = markdown.markdown(subject, Options(), 300)
    assert tiny.startswith("## usdvol-lint failed: ")
    assert tiny.count("\n") == 1
    assert len(render(subject, "markdown", Options()).encode()) <= 60_000
