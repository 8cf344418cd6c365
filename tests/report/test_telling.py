"""A cause is told once, with where else it shows; many that are alike are told in one line."""

from __future__ import annotations

from collections.abc import Sequence

import pytest
from reports import NO_EXTENTS, NO_READER, TANK, found, report, shown_on

from usdvol_lint.model import Severity, Site, StageReport, Status
from usdvol_lint.report import Options, render
from usdvol_lint.results import Report, State


def also(subject: Report, verbose: bool = False) -> list[str]:
    """What is said of other places."""
    lines = render(subject, "full", Options(verbose=verbose)).splitlines()
    return [line.strip() for line in lines if line.lstrip().startswith("also")]


def prims(number: int) -> Sequence[str]:
    return [f"/World/P{each}" for each in range(number)]


A, A_TWICE, A_MANY = (shown_on("a", TANK, *prims(number)) for number in (1, 2, 5))
B, B_MANY, C, D, E = (
    shown_on(name, TANK, *prims(number))
    for name, number in [("b", 1), ("b", 30), ("c", 1), ("d", 1), ("e", 1)]
)


@pytest.mark.parametrize(
    ("stages", "expected"),
    [
        ((A,), None),
        ((A_TWICE,), "at 1 other prim of this stage: </World/P1>"),
        ((A_MANY,), "at 4 other prims of this stage: </World/P1>, </World/P2>, </World/P3>, …"),
        ((A, B), "in 1 other stage: shots/b.usda"),
        ((A, B_MANY), "in 1 other stage: shots/b.usda"),
        ((A, B, C, D), "in 3 other stages: shots/b.usda, shots/c.usda, shots/d.usda"),
        ((A, B, C, D, E), "in 4 other stages: shots/b.usda, shots/c.usda, shots/d.usda, …"),
        ((A_TWICE, B), "at 1 other prim of this stage, and in 1 other stage: shots/b.usda"),
        ((B_MANY,), "at 29 other places of this stage"),
        ((B_MANY, C), "at 30 other places, in this stage and 1 other: shots/c.usda"),
        ((shown_on("a", TANK, "/A", "/A"),), "at 1 other place of this prim"),
        ((shown_on("a", TANK, "/A", "/A", "/B"),), "at 1 other prim of this stage: </B>"),
        ((shown_on("a", TANK, None, None),), "at 1 other place of this prim"),
    ],
    ids=[
        *("nowhere", "twice", "five", "another", "many-in-another", "four", "five-stages"),
        *("both", "cut-off", "cut-off-in-both", "same-prim", "same-and-other", "no-prim"),
    ],
)
def test_other_places_are_one_line(stages: tuple[StageReport, ...], expected: str | None) -> None:
    subject = report(*stages)
    assert also(subject) == ([f"also {expected}"] if expected else [])
    assert render(subject, "full", Options()).count("AST002") == 1
    assert len(render(subject, "concise", Options()).splitlines()) == 1


def test_a_verbose_report_names_all_other_places() -> None:
    assert also(report(A_MANY), verbose=True) == [
        "also at 4 other prims of this stage: </World/P1>, </World/P2>, </World/P3>, </World/P4>"
    ]
    (said,) = also(report(A, B, C, D, E), verbose=True)
    assert said.endswith("shots/d.usda, shots/e.usda")


def test_a_stage_where_it_is_suppressed_is_no_other_place() -> None:
    excused = B._replace(findings=(B.findings[0]._replace(ignored="as it should be"),))
    assert also(report(A, excused)) == []
    assert also(report(A, excused, C)) == ["also in 1 other stage: shots/c.usda"]
    only = report(excused)
    assert render(only, "full", Options(quiet=True)) == ""
    text = render(only, "full", Options(show=frozenset({"suppressed"})))
    assert "AST002 error (suppressed): " in text
    assert "\n      reason: as it should be\n" in text
    everywhere = report(excused, excused._replace(path="shots/z.usda"))
    text = render(everywhere, "full", Options(show=frozenset({"suppressed"})))
    assert "\n      also in 1 other stage: shots/z.usda\n" in text


def test_a_stage_whose_causes_are_told_above_says_so_with_verbose() -> None:
    asset = StageReport("assets/tank.usda", Status.CHECKED, {}, (TANK, *NO_EXTENTS))
    subject = report(asset, asset._replace(path="shots/a.usda"))
    assert "\nshots/a.usda\n" not in render(subject, "full", Options())
    assert "\nshots/a.usda\n  told above: 1 error, 5 warnings\n" in render(
        subject, "full", Options(verbose=True)
    )
    known = report(asset, asset._replace(path="shots/a.usda"), SCH007={"state": State.KNOWN})
    assert "  told above: 1 error\n" in render(known, "full", Options(verbose=True))


def test_what_is_alike_is_one_line_a_stage() -> None:
    """Not across stages, levels and states, nor where rules don't say that it is alike."""
    asset = StageReport("a.usda", Status.CHECKED, {}, NO_EXTENTS)
    text = render(report(asset), "concise", Options())
    assert text == (
        "assets/tank.usda:40:5: SCH007 warning </Tank/smoke0> no extent, so USD takes the bounds "
        "for empty … and 4 more: </Tank/smoke1>, </Tank/smoke2>, </Tank/smoke3>, … (in a.usda)\n"
    )
    first, second, third, *_ = NO_EXTENTS
    worse = second._replace(severity=Severity.ERROR)
    other = third._replace(fold="another")
    for findings in (
        (first, worse),
        (first, other),
        (first._replace(fold=None), second._replace(fold=None)),
        (first, second._replace(code="SCH008")),
    ):
        both = report(asset._replace(findings=findings))
        assert len(render(both, "concise", Options()).splitlines()) == 2
    apart = report(*(asset._replace(findings=(each,)) for each in (first, second)))
    assert len(render(apart, "concise", Options()).splitlines()) == 2
    known = report(asset)
    causes = [known.causes[0]._replace(state=State.KNOWN), *known.causes[1:]]
    text = render(known.with_causes(causes), "concise", Options(show=frozenset({"known"})))
    assert [line.endswith("(known)") for line in text.splitlines()] == [True, False]


def test_places_of_what_is_alike_are_told_together() -> None:
    """A prim whose own cause is in the line already is no other prim."""
    shot = shown_on("a", NO_EXTENTS[0], "/A", "/B", "/C")
    more = shown_on("a", NO_EXTENTS[1], "/B", "/D").findings
    subject = report(shot._replace(findings=shot.findings + more), B)
    text = render(subject, "full", Options())
    assert " … and 1 more: </B>\n" in text
    assert also(subject) == ["also at 2 other prims of this stage: </C>, </D>"]
    elsewhere = shown_on("z", NO_EXTENTS[1], "/Z")
    assert also(report(shot._replace(findings=shot.findings + more), elsewhere)) == [
        "also at 2 other prims of this stage, and in 1 other stage: shots/z.usda"
    ]


def test_a_line_for_many_names_each_prim_once_and_layers_where_there_is_none() -> None:
    sites = [
        Site("a.usda", "/A"),
        Site("a.usda", "/B", "first"),
        Site("a.usda", "/B", "second"),
        Site("c.usda"),
        Site("d.usda"),
    ]
    findings = tuple(found("SCH007", "", Severity.ERROR, "x", site, fold="f") for site in sites)
    text = render(report(StageReport("a.usda", Status.CHECKED, {}, findings)), "full", Options())
    assert text.startswith("a.usda\n  SCH007 error: x … and 4 more: d.usda, </A>, </B>\n")


def test_what_the_machine_lacks_has_no_place_to_edit() -> None:
    subject = report(StageReport("a.usda", Status.CHECKED, {}, (NO_READER,)))
    text = render(subject, "full", Options())
    assert "LNT004 warning: " in text
    assert "-->" not in text
    assert render(subject, "concise", Options()) == (
        "a.usda: LNT004 warning OpenUSD 25.5 knows no particle fields\n"
    )
