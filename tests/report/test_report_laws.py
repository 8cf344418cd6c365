"""What holds for arbitrary reports in every format."""

from __future__ import annotations

import json

import jsonschema  # type: ignore[import-untyped]
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from reports import report, without_styles
from reportschema import STRICT

from usdvol_lint.model import (
    Completed,
    Completion,
    Cover,
    Excerpt,
    Finding,
    ParticleFieldStats,
    Severity,
    Site,
    Source,
    StageReport,
    Status,
)
from usdvol_lint.report import Options, render
from usdvol_lint.report.telling import told
from usdvol_lint.results import BaselineUse, Report, RunInfo, State

VALIDATOR = jsonschema.Draft202012Validator(STRICT)

ANYTHING = st.text(alphabet=st.characters(categories=None), max_size=20) | st.sampled_from(
    [
        "",
        "\x1b[31m",
        "[red]x[/red]",
        "a\r\nb",
        "\u2028",
        "\x85",
        "\udcff",
        "\ud800",
        "'a b'",
        "::",
        "\n::error::",
        "]]>",
    ]
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
    excerpt=st.none() | st.builds(Excerpt, ANYTHING, st.integers(1, 200)),
    entry=st.none() | st.tuples(st.integers(1, 10**6), st.integers(1, 200)),
)
SOURCES = st.sampled_from([Source(None), Source("a.usda", "/A"), Source("a.usda", "/B")]) | (
    st.builds(
        Source,
        layer=st.none() | ANYTHING,
        path=st.none() | ANYTHING,
        property=st.none() | ANYTHING,
        subject=ANYTHING,
    )
)
COVERS = st.builds(
    Cover,
    level=st.sampled_from(Severity),
    frames=st.none() | TIMES,
    at_default=st.booleans(),
    share=st.none() | st.floats(0, 1),
    elements=st.none() | st.integers(1, 10**9),
)
FINDINGS = st.builds(
    Finding,
    code=st.sampled_from(["AST002", "VOL013"]) | ANYTHING,
    name=ANYTHING,
    severity=st.sampled_from(Severity),
    message=ANYTHING,
    site=SITES,
    source=SOURCES,
    cover=COVERS,
    suggestion=st.none() | ANYTHING,
    help=st.none() | ANYTHING,
    detail=st.none() | ANYTHING,
    fold=st.sampled_from([None, "one", "other"]),
    ignored=st.none() | ANYTHING,
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
FILES = st.lists(
    st.text(st.characters(codec="utf-8", exclude_characters="\0")), min_size=1, max_size=2
).map(tuple)
"""What files can be called, as the real paths of layers are."""
COMPLETIONS = st.builds(
    Completion,
    layers=FILES,
    specs=st.lists(
        st.builds(Completed, layers=FILES, path=ANYTHING, lacking=st.tuples(ANYTHING)), max_size=2
    ).map(tuple),
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
    completes=st.none() | COMPLETIONS,
)
SETTINGS: st.SearchStrategy[object] = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | ANYTHING | st.sampled_from(Severity),
    lambda inner: (
        st.lists(inner, max_size=3).map(tuple) | st.dictionaries(ANYTHING, inner, max_size=3)
    ),
    max_leaves=6,
)
BASELINES = st.builds(
    BaselineUse,
    path=ANYTHING,
    entries=st.integers(0, 10**6),
    gone=st.none() | st.lists(ANYTHING, max_size=3).map(tuple),
    partial=ANYTHING,
    moved=st.lists(st.tuples(ANYTHING, ANYTHING), max_size=7).map(tuple),
    written=st.booleans(),
)
RUNS = st.builds(
    RunInfo,
    date=ANYTHING,
    command=st.lists(ANYTHING, max_size=3).map(tuple),
    config_file=st.none() | ANYTHING,
    seconds=st.floats(0, 1e6),
    jobs=st.integers(1, 64),
)
STATES = st.sampled_from([State.NEW, State.WORSE, State.KNOWN])


@st.composite
def reports(draw: st.DrawFn) -> Report:
    """Any report, with causes in any state that they may have."""
    stages = draw(st.lists(STAGES, max_size=4))
    subject = report(*stages, most=draw(st.integers(1, 3)))
    causes = [
        cause._replace(state=draw(STATES), was=draw(st.none() | COVERS))
        if cause.state is not State.SUPPRESSED
        else cause
        for cause in subject.causes
    ]
    return subject.with_causes(causes)._replace(
        version=draw(ANYTHING),
        usd_version=draw(st.none() | ANYTHING),
        settings=draw(st.dictionaries(ANYTHING, SETTINGS, max_size=3)),
        root=draw(st.none() | ANYTHING),
        run=draw(RUNS),
        baseline=draw(st.none() | BASELINES),
    )


REPORTS = reports()
OPTIONS = st.builds(
    Options,
    color=st.booleans(),
    width=st.integers(1, 200),
    quiet=st.booleans(),
    verbose=st.booleans(),
    least=st.sampled_from([Severity.INFO, Severity.WARNING]),
    show=st.frozensets(st.sampled_from(["info", "known", "suppressed"])),
)

LAW = settings(deadline=None, max_examples=30)  # a report has many parts, each of them arbitrary


@LAW
@given(REPORTS, OPTIONS)
def test_json_is_valid_and_says_everything(subject: Report, options: Options) -> None:
    text = render(subject, "json", options)
    text.encode("utf-8")
    parsed = json.loads(text, parse_constant=pytest.fail)
    VALIDATOR.validate(parsed)
    assert [stage["path"] for stage in parsed["stages"]] == [
        joined(stage.path) for stage in subject.stages
    ]
    for said, stage in zip(parsed["stages"], subject.stages, strict=True):
        assert said["causes"] == list(stage.causes)
        assert ("particle_fields" in said) == (stage.particle_fields is not None)
        numbers = [(each["count"], each["transparent"]) for each in said.get("particle_fields", ())]
        assert numbers == [(each.count, each.transparent) for each in stage.particle_fields or ()]
    for told_once, cause in zip(parsed["causes"], subject.causes, strict=True):
        assert told_once["fingerprint"] == cause.fingerprint
        assert [
            (
                place["stage"],
                place["times"],
                place.get("message", told_once["message"]),
                place.get("suggestion", told_once["suggestion"]),
            )
            for place in told_once["places"]
        ] == [
            (place.stage, list(each.site.times), joined(each.message), maybe(each.suggestion))
            for place in cause.places
            for each in [place.finding]
        ]


def maybe(text: str | None) -> str | None:
    return None if text is None else joined(text)


def joined(text: str) -> str:
    """Text as JSON has it: there two halves of a character, one after the other, are that one."""
    return text.encode("utf-16", "surrogatepass").decode("utf-16", "surrogatepass")


@LAW
@given(REPORTS, OPTIONS)
def test_json_counts_what_it_lists(subject: Report, options: Options) -> None:
    """Whoever reads only the lists comes to the same numbers."""
    parsed = json.loads(render(subject, "json", options))
    counted = [each for each in parsed["causes"] if each["state"] in ("new", "worse")]
    for level in ("error", "warning", "info"):
        number = sum(cause["severity"] == level for cause in counted)
        assert parsed["summary"][f"{level}s"] == number
    assert sum(parsed["summary"]["by_code"].values()) == len(counted)
    assert sum(parsed["summary"]["by_state"].values()) == len(parsed["causes"])
    showing = [stage for stage in parsed["stages"] if stage["levels"]]
    assert parsed["summary"]["stages_with_findings"] == len(showing)
    for number, cause in enumerate(parsed["causes"]):
        assert 1 <= len(cause["places"]) <= cause["count"]
        for place in cause["places"]:
            assert number in parsed["stages"][place["stage"]]["causes"]


@LAW
@given(REPORTS)
def test_equal_runs_differ_below_run_alone(subject: Report) -> None:
    other = RunInfo("tomorrow", ("other",), "other.toml", 7.0, 9)
    stages = tuple(stage._replace(seconds={"open": 5.0}) for stage in subject.stages)
    again = subject._replace(run=other, stages=stages)
    one, two = (json.loads(render(each, "json", Options())) for each in (subject, again))
    assert one.pop("run") != two.pop("run")
    assert one == two


@LAW
@given(REPORTS, OPTIONS)
def test_a_cause_is_told_once_and_under_the_first_stage_that_shows_it(
    subject: Report, options: Options
) -> None:
    telling = told(subject, options)
    where = [
        (cause.fingerprint, stage)
        for stage, lines in telling.items()
        for one in lines
        for cause in one.causes
    ]
    expected = [
        (cause.fingerprint, cause.places[0].stage)
        for cause in subject.causes
        if cause.state in options.show
        or (cause.state in ("new", "worse") and cause.severity >= options.threshold)
    ]
    assert sorted(where) == sorted(expected)


@LAW
@given(REPORTS, OPTIONS)
def test_concise_has_one_line_for_what_is_told_at_once(subject: Report, options: Options) -> None:
    text = render(subject, "concise", options)
    assert len(text.splitlines()) == sum(map(len, told(subject, options).values()))
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
