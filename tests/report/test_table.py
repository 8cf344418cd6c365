"""The tables of `--summary`."""

from __future__ import annotations

import pytest
from reports import EVERYTHING, NOTHING, SMOKE, found, report, without_styles
from sharedcauses import BY_CAUSE

from usdvol_lint.config import SUMMARIES
from usdvol_lint.model import Severity, Site
from usdvol_lint.report import Options, render
from usdvol_lint.report.table import MOST_ROWS, table
from usdvol_lint.results import Report


def rows(subject: Report, by: str, **options: object) -> list[list[str]]:
    return [line.split() for line in table(subject, Options(**options), by)]  # type: ignore[arg-type]


def test_by_rule_and_by_asset() -> None:
    findings = (
        found("AST002", "file-missing", Severity.WARNING, "no", Site("b.usda", "/P0")),
        found("AST002", "file-missing", Severity.ERROR, "no", Site("a.usda", "/P1")),
        found("STG004", "units", Severity.WARNING, "no", Site("a.usda", "/P2")),
        found("STG005", "infos", Severity.INFO, "no", Site("c.usda", "/P3")),
    )
    one = SMOKE._replace(findings=findings)
    subject = report(one, one._replace(path="other.usda", findings=findings[:1]))
    assert rows(subject, "rule") == [
        ["code", "rule", "level", "causes", "places"],
        ["AST002", "file-missing", "error", "2", "3"],
        ["STG004", "units", "warning", "1", "1"],
    ]
    assert rows(subject, "asset") == [
        ["causes", "places", "level", "layer", "to", "blame"],
        ["2", "2", "error", "a.usda"],
        ["1", "2", "warning", "b.usda"],
    ]
    assert rows(subject, "stage")[1:] == [
        ["1", "2", "0", "shots/smoke.usda"],
        ["0", "1", "0", "other.usda"],
    ]
    assert rows(subject, "cause")[1] == ["1", "AST002", "error", "a.usda", "</P1>"]
    assert ["1", "STG005", "info", "c.usda", "</P3>"] in rows(subject, "cause", verbose=True)


@pytest.mark.parametrize("by", SUMMARIES)
@pytest.mark.parametrize("subject", [EVERYTHING, BY_CAUSE])
def test_columns_stand_below_one_another(by: str, subject: Report) -> None:
    lines = list(table(subject, Options(), by))
    painted = table(subject, Options(color=True), by)
    assert [without_styles(line).rstrip() for line in painted] == lines
    assert all(line == line.rstrip() for line in lines)


def test_long_tables_are_cut() -> None:
    sites = (Site("a.usda", f"/P{number:03}") for number in range(MOST_ROWS + 2))
    findings = tuple(found("AST002", "", Severity.ERROR, "no", site) for site in sites)
    subject = report(SMOKE._replace(findings=findings))
    *_, last = table(subject, Options(), "cause")
    assert last == "… and 2 rows more, with --verbose"
    assert len(list(table(subject, Options(verbose=True), "cause"))) == MOST_ROWS + 3


@pytest.mark.parametrize("by", SUMMARIES)
def test_a_summary_is_the_table_and_the_verdict(by: str) -> None:
    text = render(EVERYTHING, "full", Options(summary=by))
    told = "\n".join(table(EVERYTHING, Options(), by))
    assert text.count(told) == 1
    assert "-->" not in text
    assert list(table(NOTHING, Options(), by)) == []
