"""GitHub's annotations: what it shows of a step, and what it must not take for a command."""

from __future__ import annotations

import pytest
from reports import SMOKE, found, report

from usdvol_lint.model import Severity, Site
from usdvol_lint.report import Options, render
from usdvol_lint.results import State


def lines(errors: int, warnings: int, infos: int = 0, **options: object) -> list[str]:
    levels = [Severity.WARNING] * warnings + [Severity.ERROR] * errors + [Severity.INFO] * infos
    findings = tuple(
        found("AST002", "file-missing", level, f"no {number}", Site("a.usda", f"/P{number}"))
        for number, level in enumerate(levels)
    )
    subject = report(SMOKE._replace(findings=findings))
    return render(subject, "github", Options(**options)).splitlines()  # type: ignore[arg-type]


@pytest.mark.parametrize(("errors", "warnings"), [(10, 10), (0, 1), (1, 0), (0, 0)])
def test_what_github_shows_is_told(errors: int, warnings: int) -> None:
    said = lines(errors, warnings, infos=3)
    kinds = [line.split(" ")[0] for line in said]
    assert kinds == ["::error"] * errors + ["::warning"] * warnings


def test_what_github_would_drop_is_counted() -> None:
    *said, last = lines(13, 11)
    assert [line.split(" ")[0] for line in said] == ["::error"] * 10 + ["::warning"] * 10
    assert last == (
        "::notice title=usdvol-lint::13 errors, 11 warnings in 1 stage: "
        "3 errors, 1 warning more than GitHub shows here are in the log"
    )


def test_no_text_is_a_command_or_a_property() -> None:
    site = Site("a,line=9:\n::b%.usda", "/P", line=2, column=3)
    hostile = found("X,1", "n:m", Severity.ERROR, "one\r\n::error::two %0A\x1b", site)
    [said] = render(report(SMOKE._replace(findings=(hostile,))), "github", Options()).splitlines()
    assert said == (
        "::error file=a%2Cline=9%3A%0A%3A%3Ab%25.usda,title=X%2C1 n%3Am,line=2,col=3::"
        "one\\x0d\\x0a::error::two %250A\\x1b%0AAt </P>"
    )


def test_what_is_known_is_not_annotated() -> None:
    subject = report(SMOKE)
    known = subject.with_causes([each._replace(state=State.KNOWN) for each in subject.causes])
    assert render(known, "github", Options()) == ""
