"""What reports say, in every format, is as agreed: golden files, and words by example."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import jsonschema  # type: ignore[import-untyped]
import pytest
from process import ROOT
from reports import (
    EVERYTHING,
    FAILED,
    FIGURES,
    INFOS,
    LONG_PRIM,
    MISSING,
    NOTHING,
    SMOKE,
    found,
    report,
    without_styles,
)
from reportschema import SCHEMA, STRICT
from sharedcauses import BY_CAUSE, SHOTS_ALONE

from usdvol_lint.model import Severity, Site, StageReport, Status
from usdvol_lint.report import FORMATS, Options, render
from usdvol_lint.results import Report
from usdvol_lint.words import printable

GOLDEN = ROOT / "tests" / "golden"

GOLDENS = (
    ("full.txt", EVERYTHING, "full", Options()),
    ("full-quiet.txt", EVERYTHING, "full", Options(quiet=True)),
    ("full-verbose.txt", EVERYTHING, "full", Options(verbose=True)),
    ("full-color.txt", EVERYTHING, "full", Options(color=True, width=80, least=Severity.INFO)),
    ("full-color-wide.txt", INFOS, "full", Options(color=True, width=200, least=Severity.INFO)),
    ("full-infos.txt", INFOS, "full", Options(least=Severity.INFO)),
    ("full-infos-counted.txt", INFOS, "full", Options()),
    ("full-figures.txt", FIGURES, "full", Options()),
    ("full-clean.txt", NOTHING, "full", Options()),
    ("full-clean-color.txt", NOTHING, "full", Options(color=True)),
    ("full-causes.txt", BY_CAUSE, "full", Options()),
    ("full-causes-shown.txt", BY_CAUSE, "full", Options(show=frozenset({"known", "suppressed"}))),
    ("full-causes-verbose.txt", BY_CAUSE, "full", Options(verbose=True)),
    ("full-causes-shots.txt", SHOTS_ALONE, "full", Options()),
    ("concise.txt", EVERYTHING, "concise", Options()),
    ("concise-color.txt", EVERYTHING, "concise", Options(color=True)),
    ("concise-causes.txt", BY_CAUSE, "concise", Options(show=frozenset({"known", "suppressed"}))),
    ("report.json", EVERYTHING, "json", Options()),
    ("report-clean.json", NOTHING, "json", Options()),
    ("report-causes.json", BY_CAUSE, "json", Options()),
    ("report.jsonl", EVERYTHING, "jsonl", Options()),
    ("report-clean.jsonl", NOTHING, "jsonl", Options()),
    ("report-causes.jsonl", BY_CAUSE, "jsonl", Options()),
    ("report-failed.jsonl", FAILED, "jsonl", Options()),
    ("report.sarif", EVERYTHING, "sarif", Options()),
    ("report-clean.sarif", NOTHING, "sarif", Options()),
    ("report-causes.sarif", BY_CAUSE, "sarif", Options(category="assets")),
    ("report-failed.sarif", FAILED, "sarif", Options()),
    ("github.txt", EVERYTHING, "github", Options()),
    ("github-clean.txt", NOTHING, "github", Options()),
    ("github-causes.txt", BY_CAUSE, "github", Options()),
    ("github-failed.txt", FAILED, "github", Options()),
    ("gitlab.json", EVERYTHING, "gitlab", Options()),
    ("gitlab-clean.json", NOTHING, "gitlab", Options()),
    ("gitlab-causes.json", BY_CAUSE, "gitlab", Options()),
    ("gitlab-failed.json", FAILED, "gitlab", Options()),
    ("junit.xml", EVERYTHING, "junit", Options()),
    ("junit-clean.xml", NOTHING, "junit", Options()),
    ("junit-causes.xml", BY_CAUSE, "junit", Options(show=frozenset({"known", "suppressed"}))),
    ("junit-failed.xml", FAILED, "junit", Options()),
    ("markdown.md", EVERYTHING, "markdown", Options()),
    ("markdown-clean.md", NOTHING, "markdown", Options()),
    ("markdown-causes.md", BY_CAUSE, "markdown", Options(show=frozenset({"known", "suppressed"}))),
    ("markdown-failed.md", FAILED, "markdown", Options()),
)


@pytest.mark.parametrize(
    ("golden", "subject", "format", "options"),
    GOLDENS,
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_golden(golden: str, subject: Report, format: str, options: Options) -> None:
    """Run with UPDATE_GOLDEN=1 to write the files anew, then read the difference."""
    path = GOLDEN / golden
    actual = render(subject, format, options).encode("utf-8")
    if os.environ.get("UPDATE_GOLDEN"):
        path.write_bytes(actual)
    assert actual == path.read_bytes()


def test_every_format_has_its_golden_files() -> None:
    """One of everything and one of nothing, but for the format that says nothing then."""
    plain = [(format, subject) for _, subject, format, options in GOLDENS if options == Options()]
    assert [format for format, subject in plain if subject is EVERYTHING] == list(FORMATS)
    assert [format for format, subject in plain if subject is NOTHING] == [
        format for format in FORMATS if format != "concise"
    ]
    assert {path.name for path in GOLDEN.iterdir()} - {golden for golden, *_ in GOLDENS} == {
        "broken-shot.txt"  # of the documentation
    }


def test_quiet_says_nothing_when_clean() -> None:
    assert render(NOTHING, "full", Options(quiet=True)) == ""
    assert render(NOTHING, "full", Options(quiet=True, verbose=True)) == ""
    assert render(NOTHING, "concise", Options()) == ""
    healthy = FIGURES._replace(stages=FIGURES.stages[1:], causes=())
    assert render(healthy, "full", Options(quiet=True)) == ""
    assert "holds:" not in render(FIGURES, "full", Options(quiet=True))


def test_json_has_a_line_for_each_stage_and_each_cause() -> None:
    """Written so by code in C; written with an indent, 100,000 causes take ten times as long."""
    lines = render(BY_CAUSE, "json", Options()).splitlines()
    items = [json.loads(line.rstrip(",")) for line in lines if line.startswith("    {")]
    written = json.loads("\n".join(lines))
    assert items == written["causes"] + written["stages"]
    assert len(lines) - len(items) == 2 + 2 + len(written)


def test_json_does_not_depend_on_presentation() -> None:
    options = Options(color=True, width=10, quiet=True, verbose=True)
    assert render(EVERYTHING, "json", options) == render(EVERYTHING, "json", Options())


def test_infos_are_shown_where_they_are_asked_for() -> None:
    """Else people have their number, and with --quiet not even that."""
    assert render(INFOS, "full", Options(quiet=True)) == ""
    assert render(INFOS, "concise", Options()) == ""
    for asked in (Options(least=Severity.INFO), Options(verbose=True)):
        for format in ("full", "concise"):
            said = render(INFOS, format, asked)
            assert "FLD003" in said
            assert "--show" not in said


def test_wrapping_keeps_every_word_and_quoted_path() -> None:
    """A terminal of any width shows the same words, and paths in one piece."""
    for width in range(1, 120):
        options = Options(color=True, width=width, least=Severity.INFO)
        text = render(EVERYTHING, "full", options)
        wide = render(EVERYTHING, "full", options._replace(width=10_000))
        assert text.split() == wide.split()
        assert "'../vdb cache/smoke.0102.vdb'" in text
        assert LONG_PRIM in text


def test_a_long_list_is_whole_where_it_is_asked_for() -> None:
    """Frames to paste: some of them tell what is meant, and --verbose and JSON have them all."""
    frames = ", ".join(f"{frame}: @./fx/smoke.{frame:04}.vdb@" for frame in range(1, 101))
    advice = f"author filePath.timeSamples = {{ {frames} }}"
    finding = found("AST003", "", Severity.ERROR, "no file", Site("a.usda"), suggestion=advice)
    subject = report(StageReport("a.usda", Status.CHECKED, findings=(finding,)))
    text = render(subject, "full", Options(width=10_000))
    assert "1: @./fx/smoke.0001.vdb@, 2: @" in text
    assert "@, … (--verbose shows all of it)\n" in text
    assert len(text) < 700
    for asked in (Options(width=10_000, verbose=True), Options(width=80, verbose=True)):
        assert advice in " ".join(render(subject, "full", asked).split())
    assert json.loads(render(subject, "json", Options()))["causes"][0]["suggestion"] == advice


def test_wrapping_counts_the_cells_of_a_terminal() -> None:
    """Each of these characters is two cells wide, so two words of two fit in nine cells."""
    finding = found("AST002", "", Severity.ERROR, "煙煙 煙煙 煙煙 煙煙 煙", Site("a.usda"))
    stage = StageReport("a.usda", Status.CHECKED, findings=(finding,))
    hang = len("  AST002 error: ")

    def message(width: int) -> list[str]:
        text = render(report(stage), "full", Options(color=True, width=hang + width, quiet=True))
        return [line.strip() for line in without_styles(text).splitlines()[1:-1]]

    assert message(9) == ["AST002 error: 煙煙 煙煙", "煙煙 煙煙", "煙"]
    assert message(8) == ["AST002 error: 煙煙", "煙煙", "煙煙", "煙煙 煙"]


@pytest.mark.parametrize(
    ("times", "at_default", "expected"),
    [
        ((101.0,), False, "at frame 101"),
        ((101.5,), True, "at frames default, 101.5"),
        ((101.0, 102.0), False, "at frames 101-102"),
    ],
    ids=["one", "default", "two"],
)
def test_frames_in_words(times: tuple[float, ...], at_default: bool, expected: str) -> None:
    site = Site("a.usda", times=times, at_default=at_default)
    stage = StageReport("a.usda", Status.CHECKED, findings=(MISSING._replace(site=site),))
    assert expected in map(str.strip, render(report(stage), "full", Options()).splitlines())


def test_concise_knows_the_stage_by_any_spelling() -> None:
    stage = SMOKE._replace(path=str(Path("shots/../shots/smoke.usda").absolute()))
    stage = stage._replace(findings=(MISSING,))
    assert "(in " not in render(report(stage), "concise", Options())


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("plain [red] Дым煙", "plain [red] Дым煙"),
        ("a\nb\tc\x00", r"a\x0ab\x09c\x00"),
        ("\x1b[0m\x7f\x9b", r"\x1b[0m\x7f\x9b"),
        ("\udcff", r"\xff"),
        ("\ud800\udfff", r"\ud800\udfff"),
        ("\u202e\u2066\u200b\ufeff\u2028", r"\u202e\u2066\u200b\ufeff\u2028"),
        ("\U000e0041", r"\U000e0041"),
    ],
    ids=ascii,
)
def test_printable(text: str, expected: str) -> None:
    assert printable(text) == expected


def test_of_a_word_that_is_no_path_of_a_file_the_middle_is_left_out() -> None:
    longest = "/" + "n" * 4095
    assert printable(f"<{longest[2:]}>") == f"<{longest[2:]}>"
    assert printable(f"at {longest}n, {longest}") == (
        f"at /{'n' * 249}… 3,598 characters …{'n' * 249}, {longest}"
    )
    words = "word " * 30_000
    assert printable(words) == words


@pytest.mark.parametrize(
    ("format", "unwanted"),
    [
        (None, {"rich", "json", "usdvol_lint.report.text"}),
        ("full", {"rich", "json"}),
        ("concise", {"rich", "json"}),
        ("json", {"rich"}),
        ("sarif", {"rich", "usdvol_lint.report.text", "usdvol_lint.report.json_report"}),
        ("gitlab", {"rich", "urllib.parse", "usdvol_lint.report.json_report"}),
        ("jsonl", {"rich", "xml", "usdvol_lint.report.text"}),
        ("junit", {"rich", "json"}),
        ("markdown", {"rich", "json", "xml"}),
    ],
)
def test_imports_wait_until_needed(format: str | None, unwanted: set[str]) -> None:
    script = f"""
import sys
import usdvol_lint.report as report
from usdvol_lint.results import Report, RunInfo
if {format!r}:
    nothing = Report("1", None, {{}}, None, (), (), RunInfo())
    report.render(nothing, {format!r}, report.Options())
print(*sorted({unwanted!r} & set(sys.modules)))
"""
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True
    )
    assert done.stdout.split() == []


OPTIONAL = {"particle_fields", "message", "suggestion", "reason"}
"""What is there only if it was asked for, and what a place may say in its own words."""


def test_schema_is_valid_and_describes_itself() -> None:
    jsonschema.Draft202012Validator.check_schema(SCHEMA)
    for name, part in {"": SCHEMA, **SCHEMA["$defs"]}.items():
        if "properties" not in part:
            continue
        optional = OPTIONAL if name in ("stage", "place") else set()
        assert part["required"] == [each for each in part["properties"] if each not in optional]
        for described in part["properties"].values():
            assert "description" in described or "$ref" in described


def test_schema_allows_what_later_versions_add() -> None:
    """Our own reports have nothing that it does not describe, and a later one may."""
    written = json.loads(render(BY_CAUSE, "json", Options()))
    later = {**written, "schema_version": "2.7", "mood": "good"}
    later["causes"] = [{**cause, "owner": "fx"} for cause in written["causes"]]
    jsonschema.validate(later, SCHEMA)
    jsonschema.validate(written, STRICT)
    for more in ({"mood": "good"}, {"causes": later["causes"]}):
        with pytest.raises(jsonschema.ValidationError):
            jsonschema.validate({**written, **more}, STRICT)
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate({**written, "schema_version": "3.0"}, SCHEMA)
