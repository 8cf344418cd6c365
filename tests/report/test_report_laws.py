"""What holds for arbitrary reports in every format."""

from __future__ import annotations

import json

import jsonschema  # type: ignore[import-untyped]
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from reports import SCHEMA, without_styles

from usdvol_lint.model import (
    Finding,
    ParticleFieldStats,
    Report,
    Severity,
    Site,
    StageReport,
    Status,
)
from usdvol_lint.report import Options, render

VALIDATOR = jsonschema.Draft202012Validator(SCHEMA)

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
    least=st.sampled_from([Severity.INFO, Severity.WARNING]),
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
def test_concise_has_one_line_a_finding_that_is_shown(subject: Report, options: Options) -> None:
    text = render(subject, "concise", options)
    shown = [
        finding
        for stage in subject.stages
        for finding in stage.findings
        if options.verbose or finding.severity >= options.least
    ]
    assert len(text.splitlines()) == len(shown)
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
