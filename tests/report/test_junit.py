"""JUnit XML as its readers take it: junitparser, the schema of Jenkins, and what they count."""

from __future__ import annotations

from xml.etree import ElementTree

import junitparser
import pytest
import xmlschema
from hypothesis import given
from hypothesis import strategies as st
from process import ROOT
from reports import CLEAN, CRASHED, FAILED, MISSING, NOTHING, SMOKE, TIMED_OUT, found, report
from sharedcauses import BY_CAUSE, TANK, shown_on
from test_report_laws import LAW, OPTIONS, REPORTS

from usdvol_lint.model import Finding, Severity, Site, StageReport, Status
from usdvol_lint.report import Options, junit, render
from usdvol_lint.results import Report, State

SCHEMA = xmlschema.XMLSchema(str(ROOT / "tests" / "schemas" / "junit-10.xsd"))
PLAIN = Options()
FAIL_ON = st.none() | st.sampled_from(Severity)


def cases(subject: Report, options: Options = PLAIN) -> list[junitparser.TestCase]:
    """The test cases, of a file that is valid and counts what it holds."""
    text = render(subject, "junit", options)
    data = text.encode("utf-8")
    SCHEMA.validate(ElementTree.fromstring(data))
    suites = junitparser.JUnitXml.fromstring(data)
    (suite,) = suites
    found = list(suite)
    outcomes = [type(one) for case in found for one in case.result]
    assert suite.tests == suites.tests == len(found)
    assert suite.failures == suites.failures == outcomes.count(junitparser.Failure)
    assert suite.errors == suites.errors == outcomes.count(junitparser.Error)
    assert suite.skipped == outcomes.count(junitparser.Skipped)
    assert len({(case.classname, case.name) for case in found}) == len(found)
    return found


def texts(subject: Report, options: Options = PLAIN) -> list[tuple[str, str]]:
    """What each stage fails with, and what stands beside."""
    return [
        ("".join(one.text or "" for one in case.result), case.system_out or "")
        for case in cases(subject, options)
    ]


def stage(path: str, *findings: Finding, status: Status = Status.CHECKED) -> StageReport:
    return StageReport(path, status, findings=findings)


def broken(number: int, severity: Severity = Severity.ERROR) -> Finding:
    return found("AST002", "", severity, f"no file {number}", Site("a.usda", f"/P{number}"))


@LAW
@given(REPORTS, OPTIONS, FAIL_ON)
def test_the_file_fails_where_the_run_does(
    subject: Report, options: Options, fail_on: Severity | None
) -> None:
    options = options._replace(fail_on=fail_on)
    told = cases(subject, options)
    assert len(told) == max(1, len(subject.stages))
    for case, stage in zip(told, subject.stages, strict=False):
        assert len(case.result) <= 1
        counted = sum(n for level, n in stage.levels.items() if fail_on and level >= fail_on)
        assert bool(case.result) == (bool(counted) or stage.status is not Status.CHECKED)
        for one in case.result:
            if isinstance(one, junitparser.Failure):
                assert sum(int(each.split()[0]) for each in one.message.split(", ")) == counted
                assert one.type == max(stage.levels).label
    fails = any(options.fails(cause) for cause in subject.causes)
    unchecked = any(stage.status is not Status.CHECKED for stage in subject.stages)
    failed = any(isinstance(one, junitparser.Failure) for case in told for one in case.result)
    errors = any(isinstance(one, junitparser.Error) for case in told for one in case.result)
    assert (failed or errors) == (fails or unchecked)


@pytest.mark.parametrize(
    ("path", "expected"),
    [
        ("shots/sh010/a.usda", ("shots/sh010", "a.usda")),
        ("./shots//a.usda", ("shots", "a.usda")),
        ("a.usda", (".", "a.usda")),
        ("/mnt/show/a.usda", ("/mnt/show", "a.usda")),
        ("../a.usda", ("..", "a.usda")),
        (".", (".", ".")),
        ("a\n\x1b.usda", (".", r"a\x0a\x1b.usda")),
    ],
    ids=ascii,
)
def test_a_stage_goes_by_its_folder_and_its_name(path: str, expected: tuple[str, str]) -> None:
    (case,) = cases(report(stage(path)))
    assert (case.classname, case.name) == expected


def test_stages_of_one_name_are_told_apart() -> None:
    paths = ("a.usda (2)", "a.usda", "./a.usda", "a\x1b.usda", r"a\x1b.usda", "./a.usda")
    names = [case.name for case in cases(report(*map(stage, paths)))]
    assert names[:3] == ["a.usda (2)", "a.usda", "a.usda (3)"]
    assert len(set(names)) == len(paths)


def test_what_fails_is_one_text_and_the_rest_stands_beside() -> None:
    subject = report(
        stage("a.usda", broken(1, Severity.WARNING), broken(2), broken(3, Severity.INFO)),
        CLEAN,
    )

    def told(options: Options) -> tuple[str, list[str], list[str]]:
        (failing, beside), _ = texts(subject, options)
        first, clean = cases(subject, options)
        assert clean.result == []
        message = "".join(f"{one.type}: {one.message}" for one in first.result)
        numbers = [
            [line[-1] for line in text.splitlines() if line.startswith("AST")]
            for text in (failing, beside)
        ]
        return message, *numbers

    assert told(Options()) == ("error: 1 error", ["2"], ["1", "3"])
    everything = "error: 1 error, 1 warning, 1 info"
    assert told(Options(fail_on=Severity.INFO)) == (everything, ["2", "1", "3"], [])
    assert told(Options(fail_on=None)) == ("", [], ["2", "1", "3"])


def test_known_and_suppressed_fail_nothing() -> None:
    hidden = texts(BY_CAUSE)
    assert not any("VOL001" in part or "AST018" in part for text in hidden for part in text)
    shown = texts(BY_CAUSE, Options(show=frozenset({"known", "suppressed"})))
    assert [said for said, _ in shown] == [said for said, _ in hidden]
    assert "VOL001 error (known)" in shown[1][1]
    assert "AST018 warning (suppressed)" in shown[2][1]
    assert "reason: late frames" in shown[2][1]
    everything = report(stage("a.usda", MISSING), AST002={"state": State.KNOWN})
    assert texts(everything) == [("", "")]


def test_a_cause_looks_as_the_stage_shows_it() -> None:
    """Where a cause does not carry its place there, it says whose it has."""
    later = TANK._replace(site=TANK.site._replace(times=(7.0,)), severity=Severity.WARNING)
    subject = report(
        shown_on("a", TANK, "/A", "/B"),
        shown_on("b", later, "/C", "/D", "/E"),
        shown_on("c", later, "/F"),
        most=3,
    )
    (a, _), (b, b_beside), (_, c) = texts(subject)
    assert "at </A>, filePath, frame 3" in a
    assert "also at </B>" in a
    assert "others" not in a
    assert b == ""
    assert "AST002 warning" in b_beside
    assert "at </C>, filePath, frame 7\n  also at others" in b_beside
    assert "at </A>, filePath, frame 3\n  as shots/a.usda shows it" in c


def test_where_the_job_was_not_done_it_is_an_error() -> None:
    """Also where a rule failed on a stage, which ends a run with 2 whatever --fail-on says."""
    failed = found("LNT002", "", Severity.ERROR, "GRD001 failed", Site("a.usda"))
    subject = report(
        CRASHED, TIMED_OUT, stage("a.usda", broken(1), failed), stage("b.usda", broken(2))
    )
    told = cases(subject, Options(fail_on=None))
    results = [[(type(one).__name__, one.type, one.message) for one in c.result] for c in told]
    assert results == [
        [("Error", "crashed", "GRD001 failed: ZeroDivisionError: division by zero")],
        [("Error", "timed_out", "timed out")],
        [("Error", "failed", "GRD001 failed")],
        [],
    ]
    (*_, (error, beside), _) = texts(subject)
    assert error.index("LNT002") < error.index("no file 1")
    assert "more" not in error
    assert beside == ""


def test_there_is_a_test_in_any_case() -> None:
    (failed,) = cases(FAILED)
    (error,) = failed.result
    assert isinstance(error, junitparser.Error)
    assert error.message == error.text == FAILED.failure
    (nothing,) = cases(FAILED._replace(failure=""))
    assert [type(one) for one in nothing.result] == [junitparser.Skipped]
    assert [case.result for case in cases(NOTHING)] == [[]]
    later = cases(report(SMOKE)._replace(failure="stopped"))
    assert [type(one) for case in later for one in case.result] == [
        junitparser.Error,
        junitparser.Failure,
    ]


def test_long_texts_are_cut(monkeypatch: pytest.MonkeyPatch) -> None:
    """What small stages leave over, large ones have; and each has the same limit."""
    monkeypatch.setattr(junit, "_MOST_TOLD", 20)
    monkeypatch.setattr(junit, "_MOST_CAUSES", 15)
    few = stage("few.usda", broken(0))
    many = [
        stage(f"{letter}.usda", *(broken(number) for number in range(start, start + 40)))
        for letter, start in (("a", 1), ("b", 41))
    ]
    told = texts(report(few, *many))
    assert [text.count("no file") for text, _ in told] == [1, 9, 9]
    end = "more: --output-format json has them all"
    assert [text.splitlines()[-1] for text, _ in told[1:]] == [f"… and 31 causes {end}"] * 2
    ((alone, _),) = texts(report(many[0]))
    assert alone.count("no file") == 15
    monkeypatch.setattr(junit, "_MOST_BYTES", 200)
    ((little, _),) = texts(report(many[0]))
    assert 0 < little.count("no file") < 8
    assert len(little) < 300


def test_one_long_message_is_cut() -> None:
    ((text, _),) = texts(
        report(stage("a.usda", MISSING._replace(message="so many words " * 10**5)))
    )
    assert len(text) < 3000
    assert "…\n" in text
