"""What a worker sends arrives as it was."""

from __future__ import annotations

import pickle
from itertools import product

import pytest

from usdvol_lint.model import Cover, Excerpt, Finding, Severity, Site, Source, StageReport, Status
from usdvol_lint.run.protocol import Done, NewFindings

A = Finding(
    "AST002",
    "file-missing",
    Severity.ERROR,
    "no file at './a.vdb'",
    Site("a.usda", "/a", "filePath", None, 3, 5, (1.0, 2.0), False, Excerpt("asset filePath", 7)),
    Source("/show/a.usda", "/a", "filePath"),
    Cover(Severity.ERROR, (1.0, 2.0)),
    "write it",
    "usdvol-lint --explain AST002",
    absent=(frozenset({("/show/a.usda", "/a", "filePath")}),),
)
B = Finding(
    "SCH005",
    "token-not-allowed",
    Severity.WARNING,
    "no such token",
    Site("b.usda", None, at_default=True, entry=(4, 1)),
    Source(None, subject="usd-core"),
    Cover(Severity.WARNING, None, True, 0.5, 10),
    fold="tokens",
    since="0.2",
)


@pytest.mark.parametrize("length", [1, 2, 3])
def test_findings_arrive_as_they_were(length: int) -> None:
    """Alike or not, also where only some of them are."""
    for findings in product((A, B), repeat=length):
        arrived = list(pickle.loads(pickle.dumps(NewFindings.of(findings))).findings)
        assert arrived == list(findings)
        assert [_types(each) for each in arrived] == [_types(each) for each in findings]


def _types(finding: Finding) -> list[type]:
    return [type(each) for each in (*finding, *finding.site, *finding.cover)]


def test_a_report_arrives_as_it_was() -> None:
    report = StageReport("a.usda", Status.CHECKED, {"prims": 3}, (), {"open": 0.1})
    done = pickle.loads(pickle.dumps(Done(report, (1, 0))))
    assert done.with_findings((A, B)) == report._replace(findings=(B, A))
    assert done.report.status is Status.CHECKED
