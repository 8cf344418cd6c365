"""The report for GitLab's Code Quality: what is found, and never an empty list for no answer."""

from __future__ import annotations

from pathlib import Path

import pytest
from consumers import gitlab
from reports import CLEAN, EVERYTHING, FAILED, MISSING, NOTHING, UNREADABLE, report
from sharedcauses import BY_CAUSE

from usdvol_lint.model import Site, Source, StageReport, Status
from usdvol_lint.paths import canonical
from usdvol_lint.report import Options
from usdvol_lint.results import State


def test_an_entry_for_each_cause() -> None:
    entry = next(each for each in gitlab(EVERYTHING) if each["check_name"] == "AST002")
    assert entry == {
        "description": (
            "no file at '../vdb cache/smoke.0102.vdb' (4 of 120 frames). "
            "At </World/Smoke/density.filePath>, frames 102-104, 117. "
            "Help: render the missing frames, or end the clip at frame 101."
        ),
        "check_name": "AST002",
        "fingerprint": "bb4afaaa8b90b33a",
        "severity": "major",
        "location": {"path": "shots/smoke.usda", "lines": {"begin": 31}},
    }
    assert {each["severity"] for each in gitlab(EVERYTHING)} == {"major", "minor", "info"}


def test_fingerprints_are_unique_and_what_is_known_or_suppressed_is_left_out() -> None:
    fingerprints = [each["fingerprint"] for each in gitlab(BY_CAUSE)]
    counted = [cause.fingerprint for cause in BY_CAUSE.causes if cause.state.counts]
    assert fingerprints == counted
    assert len(set(fingerprints)) == len(counted) < len(BY_CAUSE.causes)


def test_clean_is_an_empty_list_and_a_run_that_failed_is_not() -> None:
    assert gitlab(NOTHING) == []
    (entry,) = gitlab(FAILED)
    assert (entry["description"], entry["severity"]) == (FAILED.failure, "blocker")
    (entry,) = gitlab(report(CLEAN, UNREADABLE))
    assert entry["description"] == "1 of 2 stages could not be checked: shots/broken.usdz"
    known = report(
        StageReport("a.usda", Status.UNREADABLE, findings=(MISSING._replace(code="LNT001"),)),
        LNT001={"state": State.KNOWN},
    )
    (entry,) = gitlab(known)
    assert entry["check_name"] == "usdvol-lint"
    assert len(gitlab(EVERYTHING._replace(failure="no disk"))) == len(gitlab(EVERYTHING)) + 1


def test_a_run_that_failed_stands_at_what_it_was_to_check(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """In relation to the working directory, or to the root where there is one."""
    (tmp_path / "shots").mkdir()
    monkeypatch.chdir(tmp_path / "shots")
    repository = canonical(str(tmp_path))
    options = Options(repository=repository)
    cases = [((".",), None, "shots"), (("shots",), repository, "shots"), ((), repository, ".")]
    for arguments, root, expected in cases:
        subject = FAILED._replace(arguments=arguments, root=root)
        assert gitlab(subject, options)[0]["location"]["path"] == expected


def test_what_lies_outside_has_a_relative_path_too(tmp_path: Path) -> None:
    """GitLab takes no absolute one, and has no file to show either."""
    outside = canonical(str(tmp_path / "mnt" / "a.usda"))
    finding = MISSING._replace(site=Site("a.usda", "/A"), source=Source(outside, "/A"))
    subject = report(StageReport(outside, Status.CHECKED, findings=(finding,)))
    options = Options(repository=canonical(str(tmp_path / "here")))
    (entry,) = gitlab(subject, options)
    assert entry["location"] == {"path": "../mnt/a.usda", "lines": {"begin": 1}}
    assert "In the layer a.usda." in entry["description"]


def test_a_name_that_no_text_can_hold_is_escaped() -> None:
    """GitLab reads no halves of characters; any other name is that of the file."""
    for name, expected in (("\udcff.usda", r"\xff.usda"), ("Дым\n\u202e.usda", "Дым\n\u202e.usda")):
        finding = MISSING._replace(source=Source(name, "/A"))
        (entry,) = gitlab(report(StageReport("a.usda", Status.CHECKED, findings=(finding,))))
        assert entry["location"]["path"] == expected
