"""Frames are compressed as people write them; fingerprints are stable, sorted and unique."""

from __future__ import annotations

import pickle
import random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from usdvol_lint.model import (
    Finding,
    Report,
    Severity,
    Site,
    StageReport,
    Status,
    with_fingerprints,
)
from usdvol_lint.words import format_time, frame_ranges


@pytest.mark.parametrize(
    ("times", "text"),
    [
        ((), ""),
        ((7,), "7"),
        ((7, 8), "7-8"),
        ((7, 9), "7, 9"),
        ((7, 8, 9), "7-9"),
        ((102, 103, 104, 117), "102-104, 117"),
        ((0, 2, 4, 6, 8, 10), "0-10x2"),
        ((0, 2, 4, 5, 6), "0-4x2, 5-6"),
        ((1, 3, 4, 5, 9), "1, 3-5, 9"),
        ((-2, -1, 0, 1), "-2-1"),
        ((0, 0.5, 1, 1.5), "0-1.5x0.5"),
        ((1.25, 1.5), "1.25, 1.5"),
        ((4.999999995559108, 6, 7), "5-7"),
        ((1 / 24, 2 / 24, 3 / 24), "0.041667-0.125x0.041667"),
        ((0, 10, 20, 21, 22), "0-20x10, 21-22"),
    ],
)
def test_frame_ranges(times: tuple[float, ...], text: str) -> None:
    assert frame_ranges([float(time) for time in times]) == text


@pytest.mark.parametrize(
    ("time", "text"),
    [
        (101.0, "101"),
        (101.5, "101.5"),
        (-0.0, "0"),
        (2.0**60, "1.152921504606847e+18"),
        (1e-9, "0"),
        (float("inf"), "inf"),
        (float("nan"), "nan"),
    ],
)
def test_format_time(time: float, text: str) -> None:
    assert format_time(time) == text


@given(st.sets(st.integers(-500, 500)))
def test_frame_ranges_name_exactly_the_frames(frames: set[int]) -> None:
    named: list[int] = []
    for part in filter(None, frame_ranges(sorted(map(float, frames))).split(", ")):
        ends, _, step = part.partition("x")
        split = ends.find("-", 1)
        first, last = (ends[:split], ends[split + 1 :]) if split > 0 else (ends, ends)
        named += range(int(first), int(last) + 1, int(step or 1))
    assert named == sorted(frames)


def test_frames_of_a_site() -> None:
    assert Site("a.usda").frames is None
    assert Site("a.usda", at_default=True).frames is None
    assert Site("a.usda", times=(1.0, 2.0, 3.0)).frames == "1-3"
    assert Site("a.usda", times=(1.0, 2.0, 3.0), at_default=True).frames == "default, 1-3"


FOUND = Finding(
    "AST002",
    "file-missing",
    Severity.ERROR,
    "no file at 'a.vdb'",
    Site("shots/a.usda", "/smoke", "filePath", line=3, column=1),
)


def site(finding: Finding, **changes: object) -> Finding:
    return finding._replace(site=finding.site._replace(**changes))  # type: ignore[arg-type]


def fingerprint(finding: Finding) -> str:
    (stamped,) = with_fingerprints([finding])
    return stamped.fingerprint


def test_a_fingerprint_is_a_contract() -> None:
    """Baselines that people have checked in hold these: they may never change."""
    assert fingerprint(FOUND) == "a3867d87f21ffc97"
    assert fingerprint(site(FOUND, prim=None, property=None, line=None)) == "7df28d84384ef970"


def test_what_a_fingerprint_is_made_of() -> None:
    same = [
        site(FOUND, line=99, column=None),
        site(FOUND, times=(1.0, 2.0)),
        FOUND._replace(message="no file at 'b.vdb'", severity=Severity.INFO, suggestion="x"),
    ]
    different = [
        FOUND._replace(code="AST003"),
        site(FOUND, layer="shots/b.usda"),
        site(FOUND, prim="/fire"),
        site(FOUND, property="fieldName"),
        site(FOUND, property=None),
        site(FOUND, variant="look=thick"),
    ]
    assert {fingerprint(finding) for finding in same} == {fingerprint(FOUND)}
    assert len({fingerprint(finding) for finding in [FOUND, *different]}) == 7


def test_findings_are_sorted_and_unique_whatever_their_order() -> None:
    findings = [
        site(FOUND, prim=prim, line=line)._replace(code=code, message=message)
        for prim in (None, "/a", "/b")
        for line in (None, 3, 4)
        for code in ("AST002", "GRD001")
        for message in ("one", "two")
    ]
    expected = with_fingerprints(findings)
    assert len(expected) == len({finding.fingerprint for finding in expected}) == len(findings)
    places = [(f.site.prim or "", f.site.line or 0, f.code, f.message) for f in expected]
    assert places == sorted(places)
    for seed in range(5):
        shuffled = findings * 2
        random.Random(seed).shuffle(shuffled)
        assert with_fingerprints(shuffled) == expected


def test_text_that_is_no_unicode_has_a_fingerprint() -> None:
    assert len(fingerprint(site(FOUND, layer="\udcff.usda"))) == 16


def test_summary() -> None:
    info = FOUND._replace(severity=Severity.INFO, code="LNT005")
    checked = StageReport("a.usda", Status.CHECKED, {"prims": 2}, (FOUND, info))
    broken = StageReport("b.usda", Status.UNREADABLE, {}, (FOUND._replace(code="LNT001"),))
    clean = StageReport("c.usda", Status.CHECKED, {"prims": 3, "volumes": 1})
    report = Report("1", "26.11", {}, (checked, broken, clean), 0.5)
    summary = report.summary
    assert (summary.stages, summary.stages_with_findings) == (3, 2)
    assert (summary.errors, summary.warnings, summary.infos, summary.findings) == (2, 0, 1, 3)
    assert summary.by_code == {"AST002": 1, "LNT001": 1, "LNT005": 1}
    assert summary.by_status == {"checked": 2, "unreadable": 1}
    assert summary.stats == {"prims": 5, "volumes": 1}
    assert pickle.loads(pickle.dumps(report)) == report
