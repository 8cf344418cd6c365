"""The verdict counts causes, beside a baseline too, and says what to type next."""

from __future__ import annotations

import os
from typing import Any

import pytest
from reports import (
    CLEAN,
    EVERYTHING,
    HOSTILE,
    NOTHING,
    SMOKE,
    TIMED_OUT,
    UNREADABLE,
    UNUSED,
    UNUSED_TOO,
    found,
    report,
)
from sharedcauses import KNOWN, USED, shown_on

from usdvol_lint.model import Finding, Severity, Site, StageReport, Status
from usdvol_lint.report import Options, render
from usdvol_lint.report.verdict import verdict
from usdvol_lint.results import BaselineUse, Report, State


@pytest.mark.parametrize(
    ("stages", "expected"),
    [
        ((), "no stages checked"),
        ((CLEAN,), "no findings in 1 stage; 1 volume, 1 file checked in 1.2 s"),
        (
            (SMOKE,),
            "3 errors, 1 warning in 1 stage; 1 info, shown with --show info; "
            "11 volumes, 1 particle field, 31,204 files checked in 1.2 s",
        ),
        (
            (HOSTILE, CLEAN._replace(stats={})),
            "1 error in 1 of 2 stages; no volumes or particle fields found in 1.2 s",
        ),
        (
            (CLEAN._replace(stats={"volumes": 0, "variant_selections": 2}),),
            "no findings in 1 stage; no volumes or particle fields as variants are selected, "
            "2 other selections checked in 1.2 s",
        ),
        (
            (UNREADABLE, CLEAN, TIMED_OUT),
            "no findings in 3 stages; 1 volume, 1 file checked in 1.2 s; "
            "2 stages could not be checked",
        ),
        (
            (TIMED_OUT,),
            "no findings in 1 stage; nothing counted in 1.2 s, since the stage was not read to "
            "its end; 1 stage could not be checked",
        ),
        (
            (TIMED_OUT, UNREADABLE),
            "no findings in 2 stages; nothing counted in 1.2 s, since no stage was read to its "
            "end; 2 stages could not be checked",
        ),
        (
            (UNREADABLE, CLEAN._replace(stats={}), TIMED_OUT),
            "no findings in 3 stages; no volumes or particle fields found in 1 of 3 stages in "
            "1.2 s; 2 stages could not be checked",
        ),
        (
            (UNUSED, CLEAN, UNUSED_TOO),
            "no errors or warnings in 3 stages; 2 infos, shown with --show info; "
            "23 volumes, 2 particle fields, 62,409 files checked in 1.2 s",
        ),
    ],
    ids=[
        "none",
        "clean",
        "one",
        "no-volumes",
        "other-variants",
        "unchecked",
        "unread",
        "all-unread",
        "some-unread",
        "infos",
    ],
)
def test_verdict(stages: tuple[StageReport, ...], expected: str) -> None:
    assert verdict(report(*stages), Options()) == expected


def test_verdict_of_a_short_run() -> None:
    assert verdict(NOTHING._replace(run=NOTHING.run._replace(seconds=0.049)), Options()).endswith(
        " in 0.05 s"
    )


MARK = '"' if os.name == "nt" else "'"
"""What a shell has paths with spaces in."""
SHOT = StageReport("a.usda", Status.CHECKED, {"volumes": 1}, (KNOWN,))
CHECKED = "1 volume checked in 1.2 s"


@pytest.mark.parametrize(
    ("stages", "states", "expected"),
    [
        (
            (SHOT, SHOT, CLEAN),
            {},
            "1 error in 2 of 3 stages; 3 volumes, 1 file checked in 1.2 s",
        ),
        ((SHOT,), {"state": State.WORSE}, f"1 error in 1 stage; {CHECKED}"),
        ((SHOT,), {"state": State.KNOWN}, f"no new findings in 1 stage; 1 known; {CHECKED}"),
        (
            (SHOT,),
            {"state": State.SUPPRESSED, "reason": "old"},
            f"no findings in 1 stage; 1 suppressed; {CHECKED}",
        ),
        (
            (SHOT, UNUSED),
            {"state": State.KNOWN},
            "no new errors or warnings in 2 stages; 1 info, shown with --show info; 1 known; "
            "12 volumes, 1 particle field, 31,204 files checked in 1.2 s",
        ),
        (
            (SHOT, SMOKE),
            {"state": State.KNOWN},
            "3 errors, 1 warning in 1 of 2 stages; 1 info, shown with --show info; 1 known; "
            "12 volumes, 1 particle field, 31,204 files checked in 1.2 s",
        ),
    ],
    ids=["twice", "worse", "known", "suppressed", "known-and-infos", "known-and-new"],
)
def test_the_verdict_counts_causes(
    stages: tuple[StageReport, ...], states: dict[str, Any], expected: str
) -> None:
    assert verdict(report(*stages, VOL001=states), Options()) == expected


def test_what_is_known_leaves_the_verdict_green() -> None:
    shown = Options(color=True, width=200, show=frozenset({"known"}))
    known = report(SHOT, VOL001={"state": State.KNOWN})
    assert render(known, "full", shown).splitlines()[-1].startswith("\x1b[1;32mno new findings")
    assert render(report(SHOT), "full", shown).splitlines()[-1].startswith("\x1b[1;31m1 error")


def test_a_stage_counts_where_its_own_findings_are_shown() -> None:
    """An info makes no stage one of those with errors."""
    milder = KNOWN._replace(severity=Severity.INFO)
    subject = report(SHOT, SHOT._replace(findings=(milder,)))
    assert verdict(subject, Options()).startswith("1 error in 1 of 2 stages; ")
    assert verdict(subject, Options(verbose=True)).startswith("1 error in 2 of 2 stages; ")


def beside(**changes: Any) -> Report:
    """A report beside a baseline."""
    use = BaselineUse("usdvol-lint-baseline.jsonl", entries=1)._replace(**changes)
    return report(SHOT, VOL001={"state": State.KNOWN})._replace(baseline=use)


@pytest.mark.parametrize(
    ("use", "expected"),
    [
        ({}, ""),
        ({"gone": ()}, ""),
        ({"gone": ("a",)}, "1 entry of the baseline is gone: --prune-baseline removes it; "),
        ({"gone": ("a",) * 5}, "5 entries of the baseline are gone: --prune-baseline removes them"),
        ({"partial": "it lacks shots/b.usda"}, ""),
        (
            {"written": True, "gone": ("a",)},
            "1 entry written to usdvol-lint-baseline.jsonl, without 1 that is gone; ",
        ),
        (
            {"written": True, "gone": ("a", "b")},
            "1 entry written to usdvol-lint-baseline.jsonl, without 2 that are gone; ",
        ),
        ({"written": True, "gone": ()}, "1 entry written to usdvol-lint-baseline.jsonl; "),
        ({"written": True, "entries": 12}, "12 entries written to usdvol-lint-baseline.jsonl; "),
    ],
    ids=[
        "not-known",
        "none",
        "one",
        "five",
        "partial",
        "pruned-one",
        "pruned-two",
        "written-one",
        "written",
    ],
)
def test_entries_that_are_gone_are_one_phrase(use: dict[str, Any], expected: str) -> None:
    said = verdict(beside(**use), Options())
    assert f"1 known; {expected}" in said
    assert said.replace(expected, "").count("entr") == 0


def test_a_verbose_report_names_what_is_gone() -> None:
    gone = beside(gone=("AST002 assets/old.usda </A>", "b\n"))
    assert "</A>" not in render(gone, "full", Options())
    assert render(gone, "full", Options(verbose=True)).endswith(
        "\ngone from the baseline: AST002 assets/old.usda </A>\ngone from the baseline: b\\x0a\n"
    )
    partial = beside(partial="this run lacks shots/b.usda")
    assert "lacks" not in render(partial, "full", Options())
    assert render(partial, "full", Options(verbose=True)).endswith(
        "\nwhat is gone from the baseline is not known: this run lacks shots/b.usda\n"
    )


def test_what_may_have_moved_is_said_with_what_to_type() -> None:
    pairs = [(f"old/{number}.usda", f"new/{number} 1.usda") for number in range(7)]
    lines = render(beside(moved=tuple(pairs)), "full", Options()).splitlines()[1:]
    assert lines[0] == (
        "as many entries are gone in old/0.usda as are new in new/0 1.usda: "
        f"if it moved there, add --moved {MARK}old/0.usda=new/0 1.usda{MARK}"
    )
    assert lines[5:] == ["… and 2 pairs more, told with --verbose"]
    everything = render(beside(moved=tuple(pairs)), "full", Options(verbose=True))
    assert everything.count("--moved") == 7
    assert "and 2 pairs more" not in everything
    assert render(beside(moved=USED.moved), "full", Options(quiet=True)) == ""


def many(number: int, severity: Severity = Severity.ERROR) -> tuple[Finding, ...]:
    """As many causes, all with one fold."""
    sites = (Site("a.usda", f"/World/P{each:03}") for each in range(number))
    return tuple(found("FLD002", "", severity, "wrong", site, fold="all") for site in sites)


@pytest.mark.parametrize(
    ("findings", "command", "expected"),
    [
        (many(21), ("usdvol-lint", "shots", "--jobs", "2"), "shots --jobs 2"),
        (many(21), ("usdvol-lint", "my shots"), f"{MARK}my shots{MARK}"),
        (many(21), ("usdvol-lint", "my \x07"), f"{MARK}my \\x07{MARK}"),
        (
            many(21),
            ("usdvol-lint", "--output", "o.json", "--output-format=json", "--show", "info", "a"),
            "a",
        ),
        (many(21), ("usdvol-lint", *map(str, range(200))), "and the same arguments"),
        (many(20), ("usdvol-lint", "shots"), None),
        (many(21, Severity.INFO), ("usdvol-lint", "shots"), None),
        (many(21), ("usdvol-lint", "--no-baseline", "shots"), None),
    ],
    ids=["many", "quoted", "printable", "output", "long", "few", "infos", "no-baseline"],
)
def test_who_has_many_is_told_how_to_begin(
    findings: tuple[Finding, ...], command: tuple[str, ...], expected: str | None
) -> None:
    subject = report(SHOT._replace(findings=findings))
    subject = subject._replace(run=subject.run._replace(command=command))
    lines = render(subject, "full", Options()).splitlines()
    last = next((line for line in reversed(lines) if line.startswith("adopt")), "")
    begin = "adopt them with: usdvol-lint --write-baseline usdvol-lint-baseline.jsonl "
    assert last.startswith(begin) == (expected is not None)
    if expected:
        assert last == begin + expected
    assert "adopt" not in render(subject, "full", Options(quiet=True))
    assert "adopt" not in render(subject._replace(baseline=USED), "full", Options())


def test_a_long_report_ends_with_its_numbers_and_where_more_are() -> None:
    """A table by rule, and the command that prints it by something else, alone."""
    subject = report(SHOT._replace(findings=many(21)))
    subject = subject._replace(run=subject.run._replace(command=("usdvol-lint", "shots")))
    lines = render(subject, "full", Options()).splitlines()
    head = next(number for number, line in enumerate(lines) if line.startswith("code "))
    assert lines[head + 1].split() == ["FLD002", "error", "21", "21"]
    assert lines[-1] == (
        "the numbers alone, by rule, cause, stage or asset: usdvol-lint --summary stage shots"
    )
    short = render(report(SHOT._replace(findings=many(20))), "full", Options())
    assert not any(line.startswith("code ") for line in short.splitlines())


def test_one_cause_in_many_places_is_no_reason_to_adopt() -> None:
    subject = report(shown_on("a", KNOWN, *(f"/World/P{number}" for number in range(100))))
    assert "adopt" not in render(subject, "full", Options())
    assert "adopt" not in render(EVERYTHING, "full", Options())
