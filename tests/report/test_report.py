"""Reports are compared whole: golden files for one rich report, laws for arbitrary ones."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import jsonschema  # type: ignore[import-untyped]
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from process import ROOT

from usdvol_lint.model import (
    Finding,
    ParticleFieldStats,
    Report,
    Severity,
    Site,
    StageReport,
    Status,
    printable,
)
from usdvol_lint.report import FORMATS, Options, render
from usdvol_lint.report.json_report import SCHEMA_VERSION
from usdvol_lint.report.text import verdict

GOLDEN = ROOT / "tests" / "golden"
SCHEMA: dict[str, Any] = json.loads(
    (ROOT / f"usdvol_lint/report/report-{SCHEMA_VERSION}.schema.json").read_text(encoding="utf-8")
)
VALIDATOR = jsonschema.Draft202012Validator(SCHEMA)
HELP = "https://example.org/rules"


# --- one report that has everything ----------------------------------------------------------

LONG_FOLDER = "projects/feature/sequences/sq010/shots/sq010_sh0420/effects/pyro/publish/v0017"
LONG_PRIM = "/World/Effects/Pyro/Explosion_Main/Debris_Trails/Trail_0042/Simulation/Cache/Volume"

MISSING = Finding(
    code="AST002",
    name="file-missing",
    severity=Severity.ERROR,
    message="no file at '../vdb cache/smoke.0102.vdb' (4 of 120 frames)",
    site=Site(
        layer="shots/smoke.usda",
        prim="/World/Smoke/density",
        property="filePath",
        line=31,
        column=12,
        times=(102.0, 103.0, 104.0, 117.0),
    ),
    suggestion="render the missing frames, or end the clip at frame 101",
    help=f"{HELP}/file-missing",
    fingerprint="0123456789abcdef",
)

SMOKE = StageReport(
    path="shots/smoke.usda",
    status=Status.CHECKED,
    stats={
        "prims": 1234,
        "volumes": 11,
        "fields": 24,
        "particle_fields": 1,
        "files_checked": 31204,
    },
    findings=(
        Finding(
            code="STG004",
            name="units-unsaid",
            severity=Severity.WARNING,
            message="no metersPerUnit, so that densities have no scale",
            site=Site(layer="shots/smoke.usda", line=1, column=1),
            suggestion="author metersPerUnit",
        ),
        MISSING,
        MISSING._replace(
            code="GRD001",
            name="grid-missing",
            message="no grid 'density' in '../vdb/smoke.0101.vdb', which holds 'Density'",
            site=MISSING.site._replace(
                property="fieldName",
                layer=f"{LONG_FOLDER}/smoke_payload.usda",
                line=7,
                column=None,
                times=(101.5,),
                variant="{quality=high}",
            ),
            suggestion=None,
            help=None,
        ),
        Finding(
            code="FLD003",
            name="field-unused",
            severity=Severity.INFO,
            message="no volume uses this field",
            site=Site(layer=f"{LONG_FOLDER}/lib.usdc", prim=LONG_PRIM),
            suggestion=f"bind it to a volume or remove it: {LONG_PRIM} holds 24 fields more, and "
            "each of them costs time",
        ),
        Finding(
            code="ARR001",
            name="not-finite",
            severity=Severity.ERROR,
            message="3 of 1,000,000 values are not finite, first nan at [17]",
            site=Site(
                layer="shots/smoke.usda",
                prim="/World/Splats",
                property="primvars:opacities",
                line=88,
                column=5,
                times=(1.0, 3.0, 5.0),
                at_default=True,
            ),
        ),
    ),
    seconds={"open": 0.25, "facts": 1.0, "rules": 0.125},
)

HOSTILE = StageReport(
    path="shots/\udcff[red]evil[/red].usda",
    status=Status.CHECKED,
    stats={"prims": 1},
    findings=(
        Finding(
            code="SCH001",
            name="odd-name",
            severity=Severity.ERROR,
            message="'\x1b[31mred\x1b[0m' [bold]is[/bold] :boom:\r\n::error::no\u202etxet"
            "\x9b0m \ud800",
            site=Site(
                layer="shots/\udcff[red]evil[/red].usda",
                prim="/[link=x]\n/\x07",
                property="a:\x7f\u2028b",
                line=2,
                column=3,
            ),
            suggestion="rename Дым煙\N{FIRE} \x00",
        ),
    ),
)

CRASHED = StageReport(
    path="shots/crash.usd",
    status=Status.CRASHED,
    findings=(
        Finding(
            code="LNT001",
            name="rule-failed",
            severity=Severity.ERROR,
            message="GRD001 failed: ZeroDivisionError: division by zero",
            site=Site(layer="shots/crash.usd", prim="/World"),
            detail='Traceback:\n\tFile "grid.py", line 3\nZeroDivisionError: \x1b[5mzero\n',
        ),
    ),
)

CLEAN = StageReport(
    path="shots/clean.usda", status=Status.CHECKED, stats={"volumes": 1, "files_checked": 1}
)
TIMED_OUT = StageReport(path="shots/endless.usdc", status=Status.TIMED_OUT)
UNREADABLE = StageReport(path="shots/broken.usdz", status=Status.UNREADABLE)


def report(*stages: StageReport) -> Report:
    return Report(
        version="0.1.0",
        usd_version="0.26.8",
        settings={
            "fail_on": Severity.ERROR,
            "select": frozenset({"GRD", "AST"}),
            "options": {"GRD004": {"limit": float("inf")}},
            "config": Path("studio/usdvol-lint.toml"),
            "paths": ("shots",),
            "payloads": True,
            "baseline": None,
        },
        stages=stages,
        seconds=1.2345,
    )


EVERYTHING = report(SMOKE, CLEAN, HOSTILE, CRASHED, TIMED_OUT, UNREADABLE)
NOTHING = report(CLEAN)
INFOS = report(SMOKE._replace(findings=SMOKE.findings[3:4]), CLEAN)


GOLDENS = (
    ("full.txt", EVERYTHING, "full", Options()),
    ("full-quiet.txt", EVERYTHING, "full", Options(quiet=True)),
    ("full-verbose.txt", EVERYTHING, "full", Options(verbose=True)),
    ("full-color.txt", EVERYTHING, "full", Options(color=True, width=80)),
    ("full-color-wide.txt", INFOS, "full", Options(color=True, width=200)),
    ("full-infos.txt", INFOS, "full", Options()),
    ("full-clean.txt", NOTHING, "full", Options()),
    ("full-clean-color.txt", NOTHING, "full", Options(color=True)),
    ("concise.txt", EVERYTHING, "concise", Options()),
    ("concise-color.txt", EVERYTHING, "concise", Options(color=True)),
    ("report.json", EVERYTHING, "json", Options()),
    ("report-clean.json", NOTHING, "json", Options()),
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
    assert [format for format, subject in plain if subject is NOTHING] == ["full", "json"]
    assert {path.name for path in GOLDEN.iterdir()} - {golden for golden, *_ in GOLDENS} == {
        "broken-shot.txt"  # of the documentation
    }


def test_quiet_says_nothing_when_clean() -> None:
    assert render(NOTHING, "full", Options(quiet=True)) == ""
    assert render(NOTHING, "full", Options(quiet=True, verbose=True)) == ""
    assert render(NOTHING, "concise", Options()) == ""


def test_json_does_not_depend_on_presentation() -> None:
    options = Options(color=True, width=10, quiet=True, verbose=True)
    assert render(EVERYTHING, "json", options) == render(EVERYTHING, "json", Options())


@pytest.mark.parametrize(
    ("stages", "expected"),
    [
        ((), "no stages checked"),
        ((CLEAN,), "no findings in 1 stage; 1 volume, 1 file checked in 1.2 s"),
        (
            (SMOKE,),
            "3 errors, 1 warning, 1 info in 1 stage; "
            "11 volumes, 1 particle field, 31,204 files checked in 1.2 s",
        ),
        (
            (HOSTILE, CLEAN._replace(stats={})),
            "1 error in 1 of 2 stages; no volumes or particle fields found in 1.2 s",
        ),
        (
            (UNREADABLE, CLEAN, TIMED_OUT),
            "no findings in 3 stages; 1 volume, 1 file checked in 1.2 s; "
            "2 stages could not be checked",
        ),
    ],
    ids=["none", "clean", "one", "no-volumes", "unchecked"],
)
def test_verdict(stages: tuple[StageReport, ...], expected: str) -> None:
    assert verdict(report(*stages)) == expected


def test_verdict_of_a_short_run() -> None:
    assert verdict(NOTHING._replace(seconds=0.049)).endswith(" in 0.05 s")


def test_wrapping_keeps_every_word_and_quoted_path() -> None:
    """A terminal of any width shows the same words, and paths in one piece."""
    for width in range(1, 120):
        text = render(EVERYTHING, "full", Options(color=True, width=width))
        wide = render(EVERYTHING, "full", Options(color=True, width=10_000))
        assert text.split() == wide.split()
        assert "'../vdb cache/smoke.0102.vdb'" in text
        assert LONG_PRIM in text


def test_a_long_list_is_whole_where_it_is_asked_for() -> None:
    """Frames to paste: some of them tell what is meant, and --verbose and JSON have them all."""
    frames = ", ".join(f"{frame}: @./fx/smoke.{frame:04}.vdb@" for frame in range(1, 101))
    advice = f"author filePath.timeSamples = {{ {frames} }}"
    finding = Finding("AST003", "", Severity.ERROR, "no file", Site("a.usda"), suggestion=advice)
    subject = report(StageReport("a.usda", Status.CHECKED, findings=(finding,)))
    text = render(subject, "full", Options(width=10_000))
    assert "1: @./fx/smoke.0001.vdb@, 2: @" in text
    assert "@, … (--verbose shows all of it)\n" in text
    assert len(text) < 700
    for asked in (Options(width=10_000, verbose=True), Options(width=80, verbose=True)):
        assert advice in " ".join(render(subject, "full", asked).split())
    assert (
        json.loads(render(subject, "json", Options()))["stages"][0]["findings"][0]["suggestion"]
        == advice
    )


def test_wrapping_counts_the_cells_of_a_terminal() -> None:
    """Each of these characters is two cells wide, so two words of two fit in nine cells."""
    finding = Finding("AST002", "", Severity.ERROR, "煙煙 煙煙 煙煙 煙煙 煙", Site("a.usda"))
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


@pytest.mark.parametrize(
    ("format", "unwanted"),
    [
        (None, {"rich", "json", "usdvol_lint.report.text"}),
        ("full", {"rich", "json"}),
        ("concise", {"rich", "json"}),
        ("json", {"rich"}),
    ],
)
def test_imports_wait_until_needed(format: str | None, unwanted: set[str]) -> None:
    script = f"""
import sys
import usdvol_lint.report as report
from usdvol_lint.model import Report
if {format!r}:
    report.render(Report("1", None, {{}}, (), 0.0), {format!r}, report.Options())
print(*sorted({unwanted!r} & set(sys.modules)))
"""
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True
    )
    assert done.stdout.split() == []


OPTIONAL = {"particle_fields"}
"""What is there only if it was asked for."""


def test_schema_is_valid_and_describes_itself() -> None:
    jsonschema.Draft202012Validator.check_schema(SCHEMA)
    objects = [SCHEMA, *(part for part in SCHEMA["$defs"].values() if "properties" in part)]
    for part in objects:
        assert part["additionalProperties"] is False
        assert part["required"] == [name for name in part["properties"] if name not in OPTIONAL]
        for name, described in part["properties"].items():
            assert "description" in described or "$ref" in described or name == "schema_version"


# --- laws over arbitrary reports ---------------------------------------------------------------

ANYTHING = st.text(alphabet=st.characters(categories=None), max_size=20) | st.sampled_from(
    ["", "\x1b[31m", "[red]x[/red]", "a\r\nb", "\u2028", "\x85", "\udcff", "\ud800", "'a b'", "::"]
)
TIMES = st.lists(
    st.floats(-1e6, 1e6) | st.integers(-50, 50).map(float), max_size=6, unique=True
).map(lambda times: tuple(sorted(times)))
LINES = st.none() | st.integers(1, 10**6)
SITES = st.builds(
    Site,
    layer=ANYTHING,
    prim=st.none() | ANYTHING,
    property=st.none() | ANYTHING,
    variant=st.none() | ANYTHING,
    line=LINES,
    column=LINES,
    times=TIMES,
    at_default=st.booleans(),
)
FINDINGS = st.builds(
    Finding,
    code=ANYTHING,
    name=ANYTHING,
    severity=st.sampled_from(Severity),
    message=ANYTHING,
    site=SITES,
    suggestion=st.none() | ANYTHING,
    help=st.none() | ANYTHING,
    detail=st.none() | ANYTHING,
    fingerprint=ANYTHING,
)
NUMBERS = st.floats(allow_nan=False, allow_infinity=False)
CORNERS = st.tuples(NUMBERS, NUMBERS, NUMBERS)
QUANTILES = st.fixed_dictionaries(
    dict.fromkeys(("min", "p01", "p10", "p50", "p90", "p99", "max"), NUMBERS)
)
PARTICLE_FIELDS = st.builds(
    ParticleFieldStats,
    prim=ANYTHING,
    count=st.integers(0, 10**9),
    sh_degree=st.none() | st.integers(),
    bytes=st.integers(0, 10**12),
    precision=st.sampled_from([None, "float", "half", "mixed"]),
    bounds=st.none() | st.tuples(CORNERS, CORNERS),
    opacity=st.none() | QUANTILES,
    scale=st.none() | QUANTILES,
    transparent=st.none() | st.floats(0, 1),
)
STAGES = st.builds(
    StageReport,
    path=ANYTHING,
    status=st.sampled_from(Status),
    stats=st.dictionaries(ANYTHING, st.integers(0, 10**9), max_size=3)
    | st.fixed_dictionaries({"volumes": st.integers(0, 3), "files_checked": st.integers(0, 3)}),
    findings=st.lists(FINDINGS, max_size=4).map(tuple),
    seconds=st.dictionaries(ANYTHING, st.floats(0, 1e6), max_size=3),
    particle_fields=st.none() | st.lists(PARTICLE_FIELDS, max_size=2).map(tuple),
)
SETTINGS: st.SearchStrategy[object] = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | ANYTHING | st.sampled_from(Severity),
    lambda inner: (
        st.lists(inner, max_size=3).map(tuple) | st.dictionaries(ANYTHING, inner, max_size=3)
    ),
    max_leaves=6,
)
REPORTS = st.builds(
    Report,
    version=ANYTHING,
    usd_version=st.none() | ANYTHING,
    settings=st.dictionaries(ANYTHING, SETTINGS, max_size=3),
    stages=st.lists(STAGES, max_size=3).map(tuple),
    seconds=st.floats(0, 1e6),
)
OPTIONS = st.builds(
    Options,
    color=st.booleans(),
    width=st.integers(1, 200),
    quiet=st.booleans(),
    verbose=st.booleans(),
)


LAW = settings(deadline=None)


@LAW
@given(REPORTS, OPTIONS)
def test_json_is_valid_and_says_everything(subject: Report, options: Options) -> None:
    text = render(subject, "json", options)
    text.encode("utf-8")
    parsed = json.loads(text, parse_constant=pytest.fail)
    VALIDATOR.validate(parsed)
    assert [
        (stage["path"], [(found["message"], found["times"]) for found in stage["findings"]])
        for stage in parsed["stages"]
    ] == [
        (joined(stage.path), [(joined(f.message), list(f.site.times)) for f in stage.findings])
        for stage in subject.stages
    ]
    for said, stage in zip(parsed["stages"], subject.stages, strict=True):
        assert ("particle_fields" in said) == (stage.particle_fields is not None)
        numbers = [(each["count"], each["transparent"]) for each in said.get("particle_fields", ())]
        assert numbers == [(each.count, each.transparent) for each in stage.particle_fields or ()]


def joined(text: str) -> str:
    """Text as JSON has it: there two halves of a character, one after the other, are that one."""
    return text.encode("utf-16", "surrogatepass").decode("utf-16", "surrogatepass")


@LAW
@given(REPORTS, OPTIONS)
def test_concise_has_one_line_a_finding(subject: Report, options: Options) -> None:
    text = render(subject, "concise", options)
    assert len(text.splitlines()) == sum(len(stage.findings) for stage in subject.stages)
    assert options.color or text.replace("\n", "").isprintable()
    text.encode("utf-8")


@LAW
@given(REPORTS, OPTIONS)
def test_text_has_no_foreign_control_characters(subject: Report, options: Options) -> None:
    text = render(subject, "full", options._replace(color=False))
    assert text.replace("\n", "").isprintable()
    text.encode("utf-8")


@LAW
@given(REPORTS, OPTIONS)
def test_colour_changes_nothing_else(subject: Report, options: Options) -> None:
    wide = options._replace(width=10**6, color=True)
    painted = without_styles(render(subject, "concise", wide))
    assert painted == render(subject, "concise", wide._replace(color=False))


def without_styles(text: str) -> str:
    """Text without the escape codes that set a style."""
    return re.sub(r"\x1b\[[0-9;]*m", "", text)
