"""The report line by line holds what the one in one object does, and follows its own schema."""

from __future__ import annotations

import json
from typing import Any

import jsonschema  # type: ignore[import-untyped]
import pytest
from hypothesis import given
from hypothesis import strategies as st
from process import ROOT
from referencing import Registry, Resource
from reports import report
from reportschema import SCHEMA, STRICT
from sharedcauses import BY_CAUSE, TANK, shown_on
from streams import streamed
from test_report_laws import LAW, OPTIONS, REPORTS, STAGES

from usdvol_lint.model import Severity, StageReport
from usdvol_lint.report import Options, render
from usdvol_lint.report.json_lines import JsonLines
from usdvol_lint.report.json_report import SCHEMA_VERSION
from usdvol_lint.results import Report

LINE: dict[str, Any] = json.loads(
    (ROOT / f"usdvol_lint/report/report-line-{SCHEMA_VERSION}.schema.json").read_text("utf-8")
)
VALIDATOR = jsonschema.Draft202012Validator(
    LINE, registry=Registry().with_resource(SCHEMA["$id"], Resource.from_contents(SCHEMA))
)


def lines(subject: Report, options: Options) -> list[dict[str, Any]]:
    text = render(subject, "jsonl", options)
    text.encode("utf-8")
    assert text.endswith("\n")
    return [json.loads(line, parse_constant=pytest.fail) for line in text.splitlines()]


def rebuilt(told: list[dict[str, Any]]) -> dict[str, Any]:
    """The report in one object, as a reader who knows the schema alone makes it."""
    whole: dict[str, Any] = {"causes": [], "stages": []}
    for line in told:
        match line.pop("type"):
            case "run" | "summary":
                whole |= line
            case "cause":
                assert line.pop("number") == len(whole["causes"])
                whole["causes"].append(line)
            case "change":
                whole["causes"][line.pop("cause")] |= line
            case "place":
                whole["causes"][line.pop("cause")]["places"].append(line)
            case "stage":
                assert line.pop("number") == len(whole["stages"])
                whole["stages"].append(line)
    return whole


@LAW
@given(REPORTS, OPTIONS)
def test_the_whole_report_can_be_made_of_the_lines(subject: Report, options: Options) -> None:
    told = lines(subject, options)
    for line in told:
        VALIDATOR.validate(line)
    assert all(line["type"] != "change" for line in told), "all is known already"
    whole = rebuilt(told)
    assert whole == json.loads(render(subject, "json", options))
    jsonschema.validate(whole, STRICT)


def with_paths(numbered: tuple[int, StageReport]) -> StageReport:
    """A stage with paths that files may have; others complete nothing."""
    number, stage = numbered
    lack = (frozenset({("/lib/a.usda", "/A", "x")}),)
    findings = (each._replace(absent=lack if each.absent else ()) for each in stage.findings)
    return stage._replace(path=f"{number}.usda", findings=tuple(findings), completes=None)


@LAW
@given(st.lists(STAGES, max_size=4), st.integers(1, 3))
def test_the_whole_report_can_be_made_of_what_is_told_meanwhile(
    stages: list[StageReport], most: int
) -> None:
    """What is known later is a line of its own."""
    text, subject = streamed("jsonl", list(map(with_paths, enumerate(stages))), Options(), most)
    told = [json.loads(line, parse_constant=pytest.fail) for line in text.splitlines()]
    for line in told:
        VALIDATOR.validate(line)
    assert rebuilt(told) == json.loads(render(subject, "json", Options()))


def test_a_place_that_raises_a_cause_is_a_line() -> None:
    mild = TANK._replace(severity=Severity.WARNING)
    stages = [shown_on("a", mild, "/A"), shown_on("b", TANK, "/B"), shown_on("c", mild, "/C")]
    text, _ = streamed("jsonl", stages, Options(), most=2)
    told = [json.loads(line) for line in text.splitlines()]
    assert [line["type"] for line in told[:5]] == ["run", "cause", "place", "change", "change"]
    assert (told[1]["severity"], told[1]["count"]) == ("warning", 1)
    assert told[3:5] == [
        {"type": "change", "cause": 0, "severity": "error"},
        {"type": "change", "cause": 0, "count": 3},
    ]


def test_the_lines_in_order() -> None:
    types = [line["type"] for line in lines(BY_CAUSE, Options())]
    places = [len(cause.places) - 1 for cause in BY_CAUSE.causes]
    causes = [each for more in places for each in ("cause", *["place"] * more)]
    assert types == ["run", *causes, *["stage"] * len(BY_CAUSE.stages), "summary"]


def test_a_place_may_follow_when_it_is_met() -> None:
    """As it does where a cause is told as soon as the first stage shows it."""
    other = TANK._replace(message="other", severity=Severity.INFO)
    subject = report(
        shown_on("a", TANK, "/A"), shown_on("b", TANK, "/B"), shown_on("c", other, "/C")
    )
    (cause,) = subject.causes
    writer = JsonLines(Options())
    list(writer.begin(subject))
    for number in (0, 1):
        list(writer.cause(number, cause._replace(places=cause.places[number:])))
    (text,) = writer.place(0, cause.places[2])
    line = json.loads(text)
    VALIDATOR.validate(line)
    assert (line["cause"], line["stage"], line["message"]) == (0, 2, "other")
    assert line["severity"] == "info"


def test_the_schema_describes_itself_and_what_it_refers_to() -> None:
    jsonschema.Draft202012Validator.check_schema(LINE)
    assert f"urn:usdvol-lint:report-line:{SCHEMA_VERSION}" == LINE["$id"]
    named = [one["if"]["properties"]["type"]["const"] for one in LINE["allOf"]]
    assert named == [name for name in LINE["$defs"] if name != "number"]
    assert all("description" in LINE["$defs"][name] for name in named)


@pytest.mark.parametrize("kind", ["run", "cause", "place", "stage", "summary"])
def test_the_schema_asks_for_all_of_a_line(kind: str) -> None:
    """A line of a type that later versions add passes, and none that lacks something."""
    line = next(line for line in lines(BY_CAUSE, Options()) if line["type"] == kind)
    VALIDATOR.validate({**line, "later": 1})
    VALIDATOR.validate({"type": "level", "cause": 1})
    for key in line:
        less = {name: value for name, value in line.items() if name != key}
        with pytest.raises(jsonschema.ValidationError):
            VALIDATOR.validate(less)
