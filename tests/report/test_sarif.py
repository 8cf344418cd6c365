"""The SARIF report: what code scanning reads of it, and within which limits."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import pytest
from consumers import sarif
from reports import CLEAN, CRASHED, EVERYTHING, MISSING, NOTHING, found, report
from sharedcauses import BY_CAUSE, shown_on

from usdvol_lint.model import Excerpt, Finding, Severity, Site, Source, StageReport, Status
from usdvol_lint.packs.page import Page
from usdvol_lint.paths import canonical
from usdvol_lint.report import Options
from usdvol_lint.report.sarif import MOST_PLACES, uri
from usdvol_lint.results import Report


def levels(run: Any) -> list[str]:
    return [result["level"] for result in run["results"]]


def many(number: int, severity: Severity, code: str = "AST002") -> list[Finding]:
    """So many mistakes."""
    return [
        found(code, "name", severity, f"{number}", Site("a.usda", f"/{severity}_{number}"))
        for number in range(number)
    ]


def of_findings(*findings: Finding, **more: Any) -> Report:
    return report(StageReport("a.usda", Status.CHECKED, findings=findings), **more)


def test_the_worst_come_first_and_infos_are_notes() -> None:
    kinds = ["error"] * 5 + ["warning"] + ["note"]
    assert levels(sarif(EVERYTHING)) == kinds
    assert [result["ruleId"] for result in sarif(EVERYTHING)["results"]][-2:] == [
        *("STG004", "FLD003")
    ]


def test_what_is_known_or_suppressed_is_left_out() -> None:
    """A host opens an alert for it."""
    codes = {result["ruleId"] for result in sarif(BY_CAUSE)["results"]}
    assert codes == {"AST002", "LNT004", "SCH007"}
    assert {rule["id"] for rule in sarif(BY_CAUSE)["tool"]["driver"]["rules"]} == codes


def test_the_worst_5000_are_told_and_the_cut_is_said() -> None:
    infos, errors = many(4_000, Severity.INFO), many(2_000, Severity.ERROR, "AST003")
    run = sarif(of_findings(*infos, *errors))
    assert levels(run) == ["error"] * 2_000 + ["note"] * 3_000
    assert run["properties"] == {"findings": 6_000, "findingsInThisFile": 5_000}
    (invocation,) = run["invocations"]
    (notification,) = invocation["toolExecutionNotifications"]
    assert notification["level"] == "warning"
    assert "worst 5,000 of 6,000 findings" in notification["message"]["text"]
    assert invocation["executionSuccessful"] is True


def test_nothing_is_cut_off_at_5000() -> None:
    run = sarif(of_findings(*many(5_000, Severity.ERROR)))
    assert len(run["results"]) == 5_000
    assert "properties" not in run
    assert run["invocations"] == [{"executionSuccessful": True}]


@pytest.mark.parametrize(
    ("category", "expected"),
    [
        ("", "usdvol-lint/"),
        ("lookdev", "usdvol-lint/lookdev/"),
        ("show/lookdev/", "usdvol-lint/show/lookdev/"),
    ],
)
def test_the_category_ends_with_a_slash(category: str, expected: str) -> None:
    """What follows the last slash is the name of one run to GitHub, which replaces no other."""
    run = sarif(NOTHING, Options(category=category))
    assert run["automationDetails"] == {"id": expected}


def test_the_fingerprint_is_ours() -> None:
    run = sarif(EVERYTHING)
    expected = {cause.fingerprint for cause in EVERYTHING.causes}
    said = [result["partialFingerprints"] for result in run["results"]]
    assert {each["primaryLocationLineHash"] for each in said} == expected
    assert all(len(each) == 1 for each in said)


def test_a_result_names_its_rule_by_number() -> None:
    run = sarif(EVERYTHING)
    rules = run["tool"]["driver"]["rules"]
    assert [rule["id"] for rule in rules] == sorted({rule["id"] for rule in rules})
    for result in run["results"]:
        assert rules[result["ruleIndex"]]["id"] == result["ruleId"]


def test_the_message_says_where_and_what_to_do() -> None:
    """Hosts show neither prim nor frames by themselves."""
    (result,) = sarif(of_findings(MISSING))["results"]
    assert result["message"]["text"] == (
        "no file at '../vdb cache/smoke.0102.vdb' (4 of 120 frames). "
        "At </World/Smoke/density.filePath>, frames 102-104, 117. "
        "Help: render the missing frames, or end the clip at frame 101."
    )
    (location,) = result["locations"]
    assert location == {
        "physicalLocation": {
            "artifactLocation": {"uri": "shots/smoke.usda"},
            "region": {
                "startLine": 31,
                "startColumn": 12,
                "snippet": {"text": "filePath.timeSamples = {"},
            },
        },
        "logicalLocations": [
            {"fullyQualifiedName": "/World/Smoke/density.filePath", "kind": "property"}
        ],
    }


def test_a_layer_from_elsewhere_is_in_the_message_and_its_line_is_not(tmp_path: Path) -> None:
    site = Site("../b.usda", "/A", line=70, column=9, entry=(4, 2), excerpt=Excerpt("abc", 1))
    finding = MISSING._replace(site=site, source=Source("/other/b.usda", "/A"), suggestion=None)
    stage = StageReport(str(tmp_path / "a.usda"), Status.CHECKED, findings=(finding,))
    options = Options(repository=canonical(str(tmp_path)))
    (result,) = sarif(report(stage), options)["results"]
    assert result["message"]["text"].endswith("(4 of 120 frames). At </A>. In the layer ../b.usda.")
    assert result["locations"][0]["physicalLocation"] == {
        "artifactLocation": {"uri": "a.usda"},
        "region": {"startLine": 4, "startColumn": 2},
    }


def test_text_of_a_stage_makes_no_link() -> None:
    text = "no file at '[free money](https://example.org)'"
    (result,) = sarif(of_findings(MISSING._replace(message=text)))["results"]
    assert result["message"]["text"].startswith(text.replace("](", "] ("))


def test_long_lists_are_cut_off() -> None:
    frames = ", ".join(f"{frame}: @./fx/smoke.{frame:04}.vdb@" for frame in range(1, 1001))
    (result,) = sarif(of_findings(MISSING._replace(suggestion=frames)))["results"]
    text = result["message"]["text"]
    assert text.endswith("@, ….")
    assert 1000 < len(text) < 1200


def test_other_places_are_the_stages_that_show_it() -> None:
    """Fewer than the host takes, however many the report carries."""
    prims = [f"/A{number}" for number in range(2_000)]
    subject = report(CLEAN, shown_on("a", MISSING, *prims), most=1_500)
    (result,) = sarif(subject)["results"]
    assert result["occurrenceCount"] == 2_000
    related = result["relatedLocations"]
    assert len(related) == MOST_PLACES - 1 < 1000
    assert related[0]["message"] == {"text": "also at </A1.filePath> of shots/a.usda"}
    uris = {each["physicalLocation"]["artifactLocation"]["uri"] for each in related}
    assert uris == {"shots/a.usda"}
    assert [each["id"] for each in related] == list(range(MOST_PLACES - 1))


@pytest.mark.parametrize(
    ("stages", "text"),
    [
        ([CRASHED, CLEAN], "1 of 2 stages could not be checked: shots/crash.usd"),
        ([CLEAN, CLEAN._replace(findings=many(1, Severity.ERROR, "LNT002")[:1])], "LNT002"),
    ],
)
def test_what_was_not_checked_is_no_success(stages: list[StageReport], text: str) -> None:
    (invocation,) = sarif(report(*stages))["invocations"]
    assert (invocation["executionSuccessful"], invocation["exitCode"]) == (False, 2)
    interrupted = report(*stages)._replace(failure="interrupted", interrupted=15)
    assert sarif(interrupted)["invocations"][0]["exitCode"] == 143
    (notification,) = invocation["toolExecutionNotifications"]
    assert notification["level"] == "error"
    assert text in notification["message"]["text"]


# --- rules ----------------------------------------------------------------------------------------

PAGE = """\
# file-missing (AST002)

A field names a file that is not there.

## Why it matters
USD says nothing.
Nor does Storm.

More.

## Wrong
```usda
#usda 1.0
```

## What to do
Render it.
"""


def test_rules_are_described_by_their_pages(tmp_path: Path) -> None:
    page = Page(
        "AST002",
        "file-missing",
        "A field names a file that is not there.",
        PAGE,
        tmp_path / "asset" / "file_missing.md",
    )
    options = Options(page_of=lambda code: page)
    (rule,) = sarif(of_findings(MISSING), options)["tool"]["driver"]["rules"]
    text = (
        "A field names a file that is not there.\n\n"
        "## Why it matters\nUSD says nothing.\nNor does Storm.\n\nMore.\n\n"
        "## What to do\nRender it.\n\n"
        "`usdvol-lint --explain AST002` prints the page of this rule."
    )
    assert rule == {
        "id": "AST002",
        "name": "file-missing",
        "shortDescription": {"text": page.summary},
        "fullDescription": {"text": f"{page.summary} USD says nothing. Nor does Storm."},
        "help": {"text": text, "markdown": text},
        "defaultConfiguration": {"level": "error"},
        "helpUri": "https://example.org/rules/file-missing",
        "properties": {"tags": ["asset"]},
    }


def test_a_rule_has_the_level_that_it_has_in_the_run() -> None:
    """One cause of it may be milder, or worse in one place; the command for help is no URI."""
    finding = MISSING._replace(severity=Severity.INFO, help="usdvol-lint --explain AST002")
    for settings, level in (({}, "note"), ({"rules": {"AST002": "warning"}}, "warning")):
        subject = of_findings(finding)._replace(settings=settings)
        (rule,) = sarif(subject)["tool"]["driver"]["rules"]
        assert rule["defaultConfiguration"] == {"level": level}
        assert "helpUri" not in rule


def test_a_description_is_short_enough_for_the_host(tmp_path: Path) -> None:
    page = Page("AST002", "x", "Short.", "# \n\n## Why\n" + "long " * 300, tmp_path / "x.md")
    options = Options(page_of=lambda code: page)
    (rule,) = sarif(of_findings(MISSING), options)["tool"]["driver"]["rules"]
    assert rule["fullDescription"] == {"text": "Short."}


# --- URIs -----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("file", "expected"),
    [
        ("shots/a b.usda", "shots/a%20b.usda"),
        ("100%/[x]#1?.usda", "100%25/%5Bx%5D%231%3F.usda"),
        ("a:b/c.usda", "a%3Ab/c.usda"),
        ("Дым.usda", "%D0%94%D1%8B%D0%BC.usda"),
        ("\udcff.usda", "%FF.usda"),
        ("\ud800.usda", "%ED%A0%80.usda"),
        ("a\nb.usda", "a%0Ab.usda"),
        ("", "."),
        ("/mnt/show/a b.usda", "file:///mnt/show/a%20b.usda"),
        ("//server/show/a.usda", "file://server/show/a.usda"),
        ("P:/a.usda", "file:///P:/a.usda" if os.name == "nt" else "P%3A/a.usda"),
    ],
    ids=ascii,
)
def test_uris(file: str, expected: str) -> None:
    """A name with a colon would be a scheme, one that is not UTF-8 keeps its bytes."""
    assert uri(file) == expected
