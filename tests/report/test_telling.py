"""A cause is told once, with where else it shows; many that are alike are told in one line."""

from __future__ import annotations

from collections.abc import Sequence

import pytest
from reports import found, report
from sharedcauses import KNOWN, NO_EXTENTS, NO_READER, TANK, shown_on
from streams import streamed

from usdvol_lint.model import Severity, Site, StageReport, Status
from usdvol_lint.report import Options, render
from usdvol_lint.results import Report, State


def also(subject: Report, verbose: bool = False) -> list[str]:
    """What is said of other places."""
    lines = render(subject, "full", Options(verbose=verbose)).splitlines()
    return [line.strip() for line in lines if line.lstrip().startswith("also")]


def elsewhere(subject: Report, verbose: bool = False) -> list[str]:
    """What the closing table says of other stages: how many, and which."""
    lines = iter(render(subject, "full", Options(verbose=verbose)).splitlines())
    head = next((line for line in lines if line.startswith("other stages  ")), None)
    return [
        f"{line.split()[0]}: {line[head.index('shown in') :]}"
        for line in iter(lambda: next(lines, ""), "")
        if head
    ]


def prims(number: int) -> Sequence[str]:
    return [f"/World/P{each}" for each in range(number)]


A, A_TWICE, A_MANY = (shown_on("a", TANK, *prims(number)) for number in (1, 2, 5))
B, B_MANY, C, D, E = (
    shown_on(name, TANK, *prims(number))
    for name, number in [("b", 1), ("b", 30), ("c", 1), ("d", 1), ("e", 1)]
)


@pytest.mark.parametrize(
    ("stages", "here", "there"),
    [
        ((A,), None, None),
        ((A_TWICE,), "at 1 other prim of this stage: </World/P1>", None),
        (
            (A_MANY,),
            "at 4 other prims of this stage: </World/P1>, </World/P2>, </World/P3>, …",
            None,
        ),
        ((A, B), None, "1: shots/b.usda"),
        ((A, B_MANY), None, "1: shots/b.usda"),
        ((A, B, C, D), None, "3: shots/b.usda, shots/c.usda, shots/d.usda"),
        ((A, B, C, D, E), None, "4: shots/b.usda, shots/c.usda, shots/d.usda, …"),
        ((A_TWICE, B), "at 1 other prim of this stage: </World/P1>", "1: shots/b.usda"),
        ((B_MANY,), "at 29 other places of this stage", None),
        ((B_MANY, C), "at 29 other places of this stage", "1: shots/c.usda"),
        ((shown_on("a", TANK, "/A", "/A"),), "at 1 other place of this prim", None),
        ((shown_on("a", TANK, "/A", "/A", "/B"),), "at 1 other prim of this stage: </B>", None),
        ((shown_on("a", TANK, None, None),), "at 1 other place of this prim", None),
    ],
    ids=[
        *("nowhere", "twice", "five", "another", "many-in-another", "four", "five-stages"),
        *("both", "cut-off", "cut-off-in-both", "same-prim", "same-and-other", "no-prim"),
    ],
)
def test_other_places_are_one_line_and_other_stages_a_row(
    stages: tuple[StageReport, ...], here: str | None, there: str | None
) -> None:
    subject = report(*stages)
    assert also(subject) == ([f"also {here}"] if here else [])
    assert elsewhere(subject) == ([there] if there else [])
    assert render(subject, "full", Options()).count("AST002 error: ") == 1
    assert len(render(subject, "concise", Options()).splitlines()) == 1


def test_a_verbose_report_names_all_other_places() -> None:
    assert also(report(A_MANY), verbose=True) == [
        "also at 4 other prims of this stage: </World/P1>, </World/P2>, </World/P3>, </World/P4>"
    ]
    (said,) = elsewhere(report(A, B, C, D, E), verbose=True)
    assert said.endswith("shots/d.usda, shots/e.usda")


def test_a_stage_where_it_is_suppressed_is_no_other_stage() -> None:
    excused = B._replace(findings=(B.findings[0]._replace(ignored="as it should be"),))
    assert elsewhere(report(A, excused)) == []
    assert elsewhere(report(A, excused, C)) == ["1: shots/c.usda"]
    only = report(excused)
    assert render(only, "full", Options(quiet=True)) == ""
    text = render(only, "full", Options(show=frozenset({"suppressed"})))
    assert "AST002 error (suppressed): " in text
    assert "\n      reason: as it should be\n" in text
    everywhere = report(excused, excused._replace(path="shots/z.usda"))
    text = render(everywhere, "full", Options(show=frozenset({"suppressed"})))
    assert "</Tank/fire.filePath>  shots/z.usda\n" in text


def test_a_cause_that_is_worse_later_is_told_again() -> None:
    mild = TANK._replace(severity=Severity.WARNING)
    faint = TANK._replace(severity=Severity.INFO)
    named = (("a", faint), ("b", mild), ("c", TANK))
    stages = [shown_on(name, each, "/P") for name, each in named]
    text, subject = streamed("full", stages, Options())
    assert [
        line for line in text.splitlines() if "AST002" in line or line.startswith("shots/")
    ] == [
        "shots/b.usda",
        "    AST002 warning: no file at './tank.0003.vdb' (1 of 8 samples)",
        "shots/c.usda",
        "    AST002 error: no file at './tank.0003.vdb' (1 of 8 samples)",
        "           2  AST002  error  assets/tank.usda </Tank/fire.filePath>  "
        "shots/a.usda, shots/c.usda",
    ]
    assert "\n      raised: told as warning above\n" in text
    assert render(subject, "full", Options()).count("AST002 error: ") == 1
    text, _ = streamed("concise", stages, Options())
    assert [line.split()[2] for line in text.splitlines()] == ["warning", "error"]
    assert text.endswith(" (in shots/c.usda) (raised: told as warning above)\n")


@pytest.mark.parametrize("format", ["full", "concise"])
def test_what_may_be_completed_is_told_last_and_under_its_stage(format: str) -> None:
    """A run that is over says so too."""
    absent = TANK._replace(absent=(frozenset({("/lib/tank.usda", "/Tank/fire", "filePath")}),))
    late = shown_on("a", absent, "/A")
    (other,) = shown_on("b", NO_EXTENTS[0], "/B").findings
    more = [C._replace(path=f"shots/c{number}.usda", findings=()) for number in range(20)]
    text, subject = streamed(format, [late, B._replace(findings=(other,)), *more], Options())
    assert text.index("SCH007 warning") < text.index("AST002 error")
    assert text.index("shots/b.usda") < text.index("shots/a.usda")
    assert [cause.code for cause in subject.causes] == ["SCH007", "AST002"]
    assert [stage.causes for stage in subject.stages[:2]] == [(1,), (0,)]
    both = late._replace(findings=(*late.findings, KNOWN))
    text, _ = streamed(format, [both, *more], Options())
    assert ("\nshots/a.usda (continued)\n" in text) == (format == "full")


def test_of_a_few_stages_each_has_one_section() -> None:
    absent = TANK._replace(absent=(frozenset({("/lib/tank.usda", "/Tank/fire", "filePath")}),))
    both = shown_on("a", absent, "/A")
    both = both._replace(findings=(*both.findings, KNOWN))
    more = [C._replace(path=f"shots/c{number}.usda", findings=()) for number in range(19)]
    text, _ = streamed("full", [both, *more], Options(verbose=True))
    assert "(continued)" not in text
    assert text.count("shots/a.usda\n") == 1
    section = text[: text.index("shots/c0.usda")]
    assert "told above" not in section
    assert all(code in section for code in ("AST002", KNOWN.code))


def test_what_is_suppressed_is_told_where_it_is_not_or_last() -> None:
    excused = A._replace(findings=(A.findings[0]._replace(ignored="late"),))
    text, subject = streamed("concise", [excused, B], Options())
    assert text.endswith(" (in shots/b.usda)\n")
    assert [stage.causes for stage in subject.stages] == [(0,), (0,)]
    text, _ = streamed("concise", [excused, C], Options(show=frozenset({"suppressed"})))
    assert "suppressed" not in text
    (other,) = shown_on("b", NO_EXTENTS[0], "/B").findings
    stages = [excused, B._replace(findings=(other,))]
    text, subject = streamed("concise", stages, Options(show=frozenset({"suppressed"})))
    assert [line.split()[1] for line in text.splitlines()] == ["SCH007", "AST002"]
    assert [stage.causes for stage in subject.stages] == [(1,), (0,)]


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
    other = shown_on("z", NO_EXTENTS[1], "/Z")
    both = report(shot._replace(findings=shot.findings + more), other)
    assert also(both) == also(subject)
    assert elsewhere(both) == ["1: shots/z.usda"]
    assert "assets/tank.usda </Tank/smoke0> and 1 more  " in render(both, "full", Options())


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
