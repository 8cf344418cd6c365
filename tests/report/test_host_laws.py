"""What holds for arbitrary reports in the formats of code hosts: foreign text is only text."""

from __future__ import annotations

import re
from typing import Any

from consumers import gitlab, sarif
from hypothesis import given
from hypothesis import strategies as st
from test_report_laws import LAW, REPORTS

from usdvol_lint.model import Status
from usdvol_lint.report import Options
from usdvol_lint.results import Report

PLAIN = re.compile(r"(?:[A-Za-z0-9._~/-]|%[0-9A-F]{2})+")
"""What a reference of SARIF's is made of; that of an absolute path begins with `file:`."""
HALF = re.compile("[\ud800-\udfff]")


def texts(value: Any) -> list[str]:
    """All texts in a value, but for those that are the names of files."""
    if isinstance(value, dict):
        return [text for key, each in value.items() if key != "path" for text in texts(each)]
    if isinstance(value, list):
        return [text for each in value for text in texts(each)]
    return [value] if isinstance(value, str) else []


@LAW
@given(REPORTS, st.text(max_size=9))
def test_sarif_is_valid_and_harmless(subject: Report, category: str) -> None:
    run = sarif(subject, Options(category=category))
    assert all(text.isprintable() for text in texts(run))
    counted = [cause for cause in subject.causes if cause.state.counts]
    assert len(run["results"]) == len(counted)
    locations = [
        location
        for result in run["results"]
        for location in (*result["locations"], *result.get("relatedLocations", ()))
    ]
    for location in locations:
        physical = location["physicalLocation"]
        uri = physical["artifactLocation"]["uri"]
        assert PLAIN.fullmatch(uri.removeprefix("file:")), uri
        assert physical["region"]["startLine"] >= 1
    assert run["invocations"][0]["executionSuccessful"] == all(
        stage.status is Status.CHECKED for stage in subject.stages
    )


@LAW
@given(REPORTS)
def test_gitlab_is_valid_and_harmless(subject: Report) -> None:
    entries = gitlab(subject)
    assert all(text.isprintable() for text in texts(entries))
    assert not any(HALF.search(entry["location"]["path"]) for entry in entries)
    counted = [cause for cause in subject.causes if cause.state.counts]
    is_undone = any(stage.status is not Status.CHECKED for stage in subject.stages)
    assert len(entries) == (len(counted) or int(is_undone))
